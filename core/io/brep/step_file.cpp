#include "core/io/brep/step_file.h"

#include <string>
#include <system_error>

#include <BRepBuilderAPI_Transform.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_Failure.hxx>
#include <gp_Trsf.hxx>
#include <unistd.h>

#include "core/io/brep/shape.h"

namespace hewn {
namespace {

Error failed(const char* what, const std::filesystem::path& path) {
  return {ErrorCode::Internal,
          std::string("OpenCASCADE ") + what + "; export a mesh or OpenSCAD instead",
          path.string()};
}

TopoDS_Shape in_model_units(const Brep& brep) {
  gp_Trsf scale;
  scale.SetScale(gp_Pnt(0, 0, 0), 1 / brep.scale);
  gp_Trsf move;
  move.SetTranslation(gp_Vec(brep.center.x(), brep.center.y(), brep.center.z()));
  return BRepBuilderAPI_Transform(brep.shape, move * scale, true).Shape();
}

/// The library writes to named files only: write beside the target, then rename.
Result<void> write_staged(STEPControl_Writer& writer, const std::filesystem::path& path) {
  const std::filesystem::path staging = path.string() + ".part" + std::to_string(::getpid());
  const bool is_written = writer.Write(staging.c_str()) == IFSelect_RetDone;
  std::error_code code;
  if (is_written) {
    std::filesystem::rename(staging, path, code);
    if (!code) return {};
  }
  std::error_code ignored;
  std::filesystem::remove(staging, ignored);
  return Error{
      ErrorCode::FileWrite,
      "cannot write the STEP file; choose a folder you may write to with enough free space",
      path.string()};
}

}  // namespace

Result<void> write_step_brep(const BrepInput& input, const std::filesystem::path& path,
                             const RunContext& run) {
  try {
    for (const BooleanStrategy strategy :
         {BooleanStrategy::Together, BooleanStrategy::Pairwise, BooleanStrategy::Fuzzy}) {
      const Result<Brep> brep = build_brep(input, strategy, run);
      if (!brep && brep.error().code != ErrorCode::Internal) return brep.error();
      if (!brep || !BRepCheck_Analyzer(brep->shape).IsValid()) continue;
      // The library reports to the terminal by default; this one must not.
      Message::DefaultMessenger()->ChangePrinters().Clear();
      STEPControl_Writer writer;
      if (writer.Transfer(in_model_units(*brep), STEPControl_AsIs) != IFSelect_RetDone) {
        return failed("could not translate the solid to STEP", path);
      }
      return write_staged(writer, path);
    }
  } catch (const Standard_Failure&) {
    return failed("failed while writing STEP", path);
  }
  return failed("could not build a valid solid", path);
}

}  // namespace hewn
