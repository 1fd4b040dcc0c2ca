#pragma once
/// The sources in shaders/, embedded at build time.
namespace hewn::shaders {

// NOLINTBEGIN(readability-identifier-naming): they are called like their files
extern const char* const backdrop_frag;
extern const char* const backdrop_vert;
extern const char* const ids_frag;
extern const char* const ids_vert;
extern const char* const lines_frag;
extern const char* const lines_vert;
extern const char* const mesh_frag;
extern const char* const mesh_vert;
extern const char* const sheet_frag;
extern const char* const sheet_vert;
extern const char* const tree_frag;
extern const char* const tree_vert;
// NOLINTEND(readability-identifier-naming)

}  // namespace hewn::shaders
