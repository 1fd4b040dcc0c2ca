#include "core/io/brep/faces.h"

#include <utility>

#include <BRepMesh_IncrementalMesh.hxx>
#include <BRep_Tool.hxx>
#include <Poly_Triangulation.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>

#include "core/io/brep/shape.h"

namespace hewn {
namespace {

void append_face(const TopoDS_Face& face, const Brep& brep, TriangleSoup& soup) {
  TopLoc_Location location;
  const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, location);
  if (mesh.IsNull()) return;
  const int base = static_cast<int>(soup.vertices.size());
  for (int i = 1; i <= mesh->NbNodes(); ++i) {
    const gp_Pnt p = mesh->Node(i).Transformed(location.Transformation());
    soup.vertices.emplace_back(brep.center + Vec3(p.X(), p.Y(), p.Z()) / brep.scale);
  }
  for (int i = 1; i <= mesh->NbTriangles(); ++i) {
    int a = 0;
    int b = 0;
    int c = 0;
    mesh->Triangle(i).Get(a, b, c);
    if (face.Orientation() == TopAbs_REVERSED) std::swap(b, c);
    soup.triangles.push_back({base + a - 1, base + b - 1, base + c - 1});
  }
}

Result<TriangleSoup> triangulated(const Brep& brep, double angle_deg, double deflection) {
  try {
    const BRepMesh_IncrementalMesh mesher(brep.shape, deflection * kBrepDiagonal, false,
                                          angle_deg * kPi / 180, false);
    TriangleSoup soup;
    for (TopExp_Explorer e(brep.shape, TopAbs_FACE); e.More(); e.Next()) {
      append_face(TopoDS::Face(e.Current()), brep, soup);
    }
    return soup;
  } catch (const Standard_Failure&) {
    return Error{ErrorCode::Internal, "OpenCASCADE could not tessellate the solid", "mesh export"};
  }
}

}  // namespace

Result<TriangleSoup> triangulate_brep(const BrepInput& input, BooleanStrategy strategy,
                                      double angle_deg, double deflection, const RunContext& run) {
  const Result<Brep> brep = build_brep(input, strategy, run);
  if (!brep) return brep.error();
  return triangulated(*brep, angle_deg, deflection);
}

}  // namespace hewn
