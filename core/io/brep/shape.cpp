#include "core/io/brep/shape.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <BRepAdaptor_Curve.hxx>
#include <BRepAlgoAPI_BooleanOperation.hxx>
#include <BRepAlgoAPI_Common.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_GTransform.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <ShapeUpgrade_UnifySameDomain.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <fmt/format.h>
#include <gp_Ax2.hxx>
#include <gp_Circ.hxx>
#include <gp_GTrsf.hxx>

#include "core/csg/prism.h"

namespace hewn {
namespace {

gp_Pnt point(const Vec3& p) { return {p.x(), p.y(), p.z()}; }
gp_Dir direction(const Vec3& d) { return {d.x(), d.y(), d.z()}; }

/// The profile of a spindle torus is the part of its circle off the axis, revolved.
TopoDS_Shape spindle_torus(const gp_Ax2& frame, double major, double minor) {
  const gp_Dir x = frame.XDirection();
  const gp_Dir z = frame.Direction();
  const auto at = [&](double r, double h) {
    return gp_Pnt(frame.Location().XYZ() + x.XYZ() * r + z.XYZ() * h);
  };
  const double reach = std::sqrt(minor * minor - major * major);
  // Seen along -y, so that angles grow from x towards z.
  const gp_Circ circle(gp_Ax2(at(major, 0), frame.YDirection().Reversed(), x), minor);
  const double end = std::atan2(reach, -major);
  BRepBuilderAPI_MakeWire wire(BRepBuilderAPI_MakeEdge(circle, -end, end).Edge(),
                               BRepBuilderAPI_MakeEdge(at(0, reach), at(0, -reach)).Edge());
  BRepBuilderAPI_MakeFace face(wire.Wire());
  return BRepPrimAPI_MakeRevol(face.Face(), gp_Ax1(frame.Location(), z)).Shape();
}

TopoDS_Shape regular_prism(const Literal& s, const gp_Ax2& frame, double k) {
  BRepBuilderAPI_MakePolygon outline;
  for (int i = 0; i < s.sides; ++i) {
    const Vec2 corner = k * prism_corner(s, i);
    outline.Add(gp_Pnt(frame.Location().XYZ() + frame.XDirection().XYZ() * corner.x() +
                       frame.YDirection().XYZ() * corner.y()));
  }
  outline.Close();
  const BRepBuilderAPI_MakeFace face(outline.Wire(), true);
  return BRepPrimAPI_MakePrism(face.Face(), gp_Vec(frame.Direction()) * (s.height * k)).Shape();
}

class BrepBuilder {
 public:
  BrepBuilder(const BrepInput& input, BooleanStrategy strategy, const RunContext& run)
      : tree_(input.tree), strategy_(strategy), run_(run) {
    out_.center = input.bounds.center();
    out_.scale = kBrepDiagonal / input.bounds.diagonal();
  }

  Result<Brep> build() {
    Result<TopoDS_Shape> shape = node(tree_.root);
    if (!shape) return shape.error();
    ShapeUpgrade_UnifySameDomain unify(*shape);
    unify.Build();
    // On spheres that are cut several times the unifier tears faces apart.
    const TopoDS_Shape unified = unify.Shape();
    out_.shape = BRepCheck_Analyzer(unified).IsValid() ? unified : *shape;
    return out_;
  }

 private:
  static constexpr double kFuzz = 2e-5;  ///< of a diagonal of kBrepDiagonal

  Vec3 to_shape(const Vec3& x) const { return (x - out_.center) * out_.scale; }

  Result<TopoDS_Shape> literal(const Literal& s) const {
    if (s.stretch) return stretched(s);
    return solid(s,
                 {point(to_shape(s.to_world(Vec3::Zero()))), direction(s.rotation.col(2)),
                  direction(s.rotation.col(0))},
                 out_.scale);
  }

  /// The canonical solid, mapped; OpenCASCADE turns its surfaces into splines.
  Result<TopoDS_Shape> stretched(const Literal& s) const {
    Result<TopoDS_Shape> canonical = solid(s, gp_Ax2(), 1);
    if (!canonical) return canonical;
    const Mat3 m = out_.scale * s.rotation * s.stretch->matrix;
    const Vec3 t = to_shape(s.to_world(Vec3::Zero()));
    gp_GTrsf map;
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) map.SetValue(i + 1, k + 1, m(i, k));
      map.SetValue(i + 1, 4, t[i]);
    }
    TopoDS_Shape shape = BRepBuilderAPI_GTransform(*canonical, map, true).Shape();
    // A map that mirrors turns the faces inside out.
    if (m.determinant() < 0) shape.Reverse();
    return shape;
  }

  /// The canonical solid in `frame`, its lengths times `k`.
  Result<TopoDS_Shape> solid(const Literal& s, const gp_Ax2& frame, double k) const {
    switch (s.kind) {
      case SolidKind::Box:
        return BRepPrimAPI_MakeBox(frame, s.size.x() * k, s.size.y() * k, s.size.z() * k).Shape();
      case SolidKind::Cylinder:
        if (s.radius == s.top_radius) {
          return BRepPrimAPI_MakeCylinder(frame, s.radius * k, s.height * k).Shape();
        }
        return BRepPrimAPI_MakeCone(frame, s.radius * k, s.top_radius * k, s.height * k).Shape();
      case SolidKind::Prism:
        return regular_prism(s, frame, k);
      case SolidKind::Sphere:
        return BRepPrimAPI_MakeSphere(frame, s.radius * k).Shape();
      case SolidKind::Torus:
        if (s.major_radius > s.radius) {
          return BRepPrimAPI_MakeTorus(frame, s.major_radius * k, s.radius * k).Shape();
        }
        return spindle_torus(frame, s.major_radius * k, s.radius * k);
      case SolidKind::Polyhedron:
        return polyhedron(s);
    }
    return Error{ErrorCode::Internal, "a literal of unknown kind", "boundary representation"};
  }

  Result<TopoDS_Shape> polyhedron(const Literal& s) const {
    BRepBuilderAPI_Sewing sewing(1e-6);
    const Mesh& mesh = *s.polyhedron;
    const bool is_mirrored = s.rotation.determinant() < 0;
    for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
      if (mesh.areas[t] <= 0) continue;
      const auto corner = [&](int i) { return point(to_shape(s.to_world(mesh.corner(t, i)))); };
      BRepBuilderAPI_MakePolygon outline(corner(0), corner(is_mirrored ? 2 : 1),
                                         corner(is_mirrored ? 1 : 2), true);
      BRepBuilderAPI_MakeFace face(outline.Wire(), true);
      if (face.IsDone()) sewing.Add(face.Face());
    }
    sewing.Perform();
    BRepBuilderAPI_MakeSolid solid;
    for (TopExp_Explorer e(sewing.SewedShape(), TopAbs_SHELL); e.More(); e.Next()) {
      solid.Add(TopoDS::Shell(e.Current()));
    }
    if (solid.IsDone()) return solid.Shape();
    return Error{ErrorCode::Internal, "the polyhedron's faces could not be sewn into a solid",
                 "boundary representation"};
  }

  Result<TopoDS_Shape> node(int index) {
    if (run_.is_cancelled()) return RunContext::cancelled();
    const Node& n = tree_.nodes[index];
    if (n.op == Op::Literal) return literal(tree_.literals[n.literal]);
    std::vector<TopoDS_Shape> operands;
    for (const int child : n.children) {
      Result<TopoDS_Shape> shape = node(child);
      if (!shape) return shape;
      operands.push_back(*shape);
    }
    if (operands.size() == 1) return operands.front();
    // An intersection of many arguments is not what OpenCASCADE computes in one go.
    if (strategy_ == BooleanStrategy::Together && n.op != Op::Intersection) {
      return combine(n.op, operands);
    }
    TopoDS_Shape result = operands.front();
    for (std::size_t i = 1; i < operands.size(); ++i) {
      Result<TopoDS_Shape> next = combine(n.op, {result, operands[i]});
      if (!next) return next;
      result = *next;
    }
    return result;
  }

  /// The first operand with all others at once.
  Result<TopoDS_Shape> combine(Op op, const std::vector<TopoDS_Shape>& operands) const {
    if (run_.is_cancelled()) return RunContext::cancelled();
    BRepAlgoAPI_Fuse fuse;
    BRepAlgoAPI_Cut cut;
    BRepAlgoAPI_Common common;
    BRepAlgoAPI_BooleanOperation& boolean =
        op == Op::Union        ? static_cast<BRepAlgoAPI_BooleanOperation&>(fuse)
        : op == Op::Difference ? static_cast<BRepAlgoAPI_BooleanOperation&>(cut)
                               : common;
    TopTools_ListOfShape arguments;
    TopTools_ListOfShape tools;
    arguments.Append(operands.front());
    for (std::size_t i = 1; i < operands.size(); ++i) tools.Append(operands[i]);
    boolean.SetArguments(arguments);
    boolean.SetTools(tools);
    boolean.SetNonDestructive(true);
    boolean.SetRunParallel(false);
    if (strategy_ == BooleanStrategy::Fuzzy) boolean.SetFuzzyValue(kFuzz);
    boolean.Build();
    if (!boolean.HasErrors() && !boolean.Shape().IsNull()) return boolean.Shape();
    return Error{ErrorCode::Internal,
                 fmt::format("OpenCASCADE could not combine {} solids", operands.size()),
                 "boundary representation"};
  }

  const Tree& tree_;
  BooleanStrategy strategy_;
  const RunContext& run_;
  Brep out_;
};

}  // namespace

Result<Brep> build_brep(const BrepInput& input, BooleanStrategy strategy, const RunContext& run) {
  const Box3& box = input.bounds;
  if (box.is_empty() || !std::isfinite(box.diagonal()) || box.diagonal() <= 0) {
    return Error{ErrorCode::InvalidArgument, "the tree is empty: there is no solid to export",
                 "boundary representation"};
  }
  try {
    return BrepBuilder(input, strategy, run).build();
  } catch (const Standard_Failure& e) {
    const char* text = e.GetMessageString();
    return Error{ErrorCode::Internal,
                 fmt::format("OpenCASCADE failed: {}", text && *text ? text : "no reason given"),
                 "boundary representation"};
  }
}

}  // namespace hewn
