#include "core/synth/decompose/open_cells.h"

namespace hewn {

void OpenCells::reset(const ColumnTable& columns, const std::vector<Word>& open,
                      const std::vector<Word>* gained, bool fills) {
  const std::vector<Word>& wanted = columns.wanted();
  const Word flip = fills ? 0 : ~Word{0};
  others_.resize(columns.words());
  same_.resize(columns.words());
  for (std::size_t i = 0; i < others_.size(); ++i) {
    const Word fits = wanted[i] ^ flip;
    others_[i] = open[i] & ~fits;
    same_[i] = open[i] & fits;
    if (gained != nullptr) same_[i] &= (*gained)[i];
  }
  blocks_.clear();
  for (std::size_t i = 0; i < others_.size(); i += kWordBlock) {
    blocks_.push_back(static_cast<std::uint32_t>(i));
  }
  take_in(*this, columns.all().data());
}

void OpenCells::take_in(const OpenCells& all, const Word* column) {
  others_.resize(all.others_.size());
  same_.resize(all.same_.size());
  blocks_.resize(all.blocks_.size());
  std::size_t kept = 0;
  for (const std::uint32_t block : all.blocks_) {
    Word any = 0;
    for (std::size_t i = block; i < block + kWordBlock; ++i) {
      others_[i] = all.others_[i] & column[i];
      same_[i] = all.same_[i] & column[i];
      any |= others_[i] | same_[i];
    }
    if (any != 0) blocks_[kept++] = block;
  }
  blocks_.resize(kept);
}

CommonCounts OpenCells::count() const {
  // In common with all that are left.
  const Word* columns[] = {others_.data(), same_.data()};
  CommonCounts in[2];
  count(columns, in);
  return {in[0].a, in[1].b};
}

void OpenCells::count(std::span<const Word* const> columns, std::span<CommonCounts> out) const {
  bit_kernels().count_common_in(others_.data(), same_.data(), columns, blocks_, out);
}

}  // namespace hewn
