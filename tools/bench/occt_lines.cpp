// rimline_occt_lines: the lines of a mesh by HLRBRep_PolyAlgo of Open CASCADE, for `rimline bench lines`.
//
// Reads what blender_lines.py reads from standard input, and prints the same line, without segments. Each triangle
// becomes a planar face that shares its edges with its neighbors. PolyAlgo marks no outlines of such a shape, so it
// hides all edges. What it says of them depends on the order of the corners, which visibility does not. Whether the
// shape or PolyAlgo is at fault is not known, so only its time is compared.

#include <BRep_Builder.hxx>
#include <Geom_Line.hxx>
#include <Geom_Plane.hxx>
#include <HLRAlgo_EdgeStatus.hxx>
#include <HLRAlgo_Projector.hxx>
#include <HLRBRep_PolyAlgo.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <Standard_Version.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <gp_Ax2.hxx>
#include <gp_Pln.hxx>
#include <map>
#include <utility>
#include <vector>

namespace {

constexpr double k_tolerance = 1e-9;

template <typename Number>
std::vector<Number> read(std::size_t count) {
    std::vector<Number> numbers(count);
    if (std::fread(numbers.data(), sizeof(Number), count, stdin) != count) {
        std::fputs("rimline_occt_lines: standard input ends early\n", stderr);
        std::exit(1);
    }
    return numbers;
}

// An edge and the first of its faces.
struct MeshEdge {
    TopoDS_Edge edge;
    TopoDS_Face face;
};

class MeshShell {
public:
    explicit MeshShell(const std::vector<float>& positions) {
        builder_.MakeShell(shell_);
        for (std::size_t i = 0; i < positions.size(); i += 3) {
            points_.emplace_back(positions[i], positions[i + 1], positions[i + 2]);
            builder_.MakeVertex(vertices_.emplace_back(), points_.back(), k_tolerance);
        }
    }

    // Leaves out triangles without an area.
    void add(const std::array<std::uint32_t, 3>& corners) {
        const std::array<gp_Pnt, 3> at{points_[corners[0]], points_[corners[1]],
                                       points_[corners[2]]};
        const gp_Vec normal = gp_Vec(at[0], at[1]).Crossed(gp_Vec(at[0], at[2]));
        if (normal.Magnitude() < 1e-30) return;
        Handle(Poly_Triangulation) triangle = new Poly_Triangulation(3, 1, Standard_False);
        for (int k = 0; k < 3; ++k) triangle->SetNode(k + 1, at[static_cast<std::size_t>(k)]);
        triangle->SetTriangle(1, Poly_Triangle(1, 2, 3));
        TopoDS_Face face;
        builder_.MakeFace(face, new Geom_Plane(gp_Pln(at[0], gp_Dir(normal))), k_tolerance);
        builder_.UpdateFace(face, triangle);
        TopoDS_Wire wire;
        builder_.MakeWire(wire);
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t from = corners[static_cast<std::size_t>(k)];
            const std::uint32_t to = corners[static_cast<std::size_t>((k + 1) % 3)];
            const bool is_reversed = from > to;
            MeshEdge& edge = edge_between(std::min(from, to), std::max(from, to), face);
            TColStd_Array1OfInteger nodes(1, 2);
            nodes(1) = (is_reversed ? (k + 1) % 3 : k) + 1;
            nodes(2) = (is_reversed ? k : (k + 1) % 3) + 1;
            TColStd_Array1OfReal along(1, 2);
            along(1) = 0.0;
            along(2) = points_[from].Distance(points_[to]);
            builder_.UpdateEdge(edge.edge, new Poly_PolygonOnTriangulation(nodes, along), triangle);
            builder_.Add(wire, edge.edge.Oriented(is_reversed ? TopAbs_REVERSED : TopAbs_FORWARD));
        }
        builder_.Add(face, wire);
        builder_.Add(shell_, face);
    }

    const TopoDS_Shell& shell() const { return shell_; }

private:
    MeshEdge& edge_between(std::uint32_t from, std::uint32_t to, const TopoDS_Face& face) {
        MeshEdge& edge = edges_[{from, to}];
        if (!edge.edge.IsNull()) {
            builder_.Continuity(edge.edge, edge.face, face, GeomAbs_G1);
            return edge;
        }
        const gp_Pnt &a = points_[from], &b = points_[to];
        builder_.MakeEdge(edge.edge, new Geom_Line(a, gp_Dir(gp_Vec(a, b))), k_tolerance);
        builder_.Range(edge.edge, 0.0, a.Distance(b));
        builder_.Add(edge.edge, vertices_[from].Oriented(TopAbs_FORWARD));
        builder_.Add(edge.edge, vertices_[to].Oriented(TopAbs_REVERSED));
        edge.face = face;
        return edge;
    }

    BRep_Builder builder_;
    TopoDS_Shell shell_;
    std::vector<gp_Pnt> points_;
    std::vector<TopoDS_Vertex> vertices_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, MeshEdge> edges_;
};

}  // namespace

int main() {
    const std::vector<std::uint64_t> counts = read<std::uint64_t>(2);
    const std::vector<float> positions = read<float>(3 * counts[0]);
    const std::vector<std::uint32_t> corners = read<std::uint32_t>(3 * counts[1]);
    const std::vector<double> camera = read<double>(13);
    const gp_Pnt eye(camera[0], camera[1], camera[2]);
    const gp_Dir right(camera[3], camera[4], camera[5]);
    const gp_Dir forward(camera[9], camera[10], camera[11]);

    MeshShell mesh(positions);
    for (std::size_t i = 0; i < corners.size(); i += 3)
        mesh.add({corners[i], corners[i + 1], corners[i + 2]});

    // The plane of the picture lies before the eye by the focal length, which is that of the middle of the mesh.
    gp_XYZ middle;
    for (std::size_t i = 0; i < positions.size(); i += 3)
        middle += gp_XYZ(positions[i], positions[i + 1], positions[i + 2]) *
                  (3.0 / double(positions.size()));
    const double focus = gp_Vec(eye, gp_Pnt(middle)).Dot(gp_Vec(forward));
    const gp_Pnt center(eye.XYZ() + forward.XYZ() * focus);
    const HLRAlgo_Projector projector(gp_Ax2(center, forward.Reversed(), right), focus);

    const auto start = std::chrono::steady_clock::now();
    Handle(HLRBRep_PolyAlgo) algorithm = new HLRBRep_PolyAlgo();
    algorithm->Load(mesh.shell());
    algorithm->Projector(projector);
    algorithm->Update();
    std::size_t edges = 0;
    for (algorithm->InitHide(); algorithm->MoreHide(); algorithm->NextHide()) {
        HLRAlgo_EdgeStatus status;
        TopoDS_Shape shape;
        Standard_Boolean is_smooth = false, is_sewn = false, is_outline = false, is_isoline = false;
        algorithm->Hide(status, shape, is_smooth, is_sewn, is_outline, is_isoline);
        ++edges;
    }
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;

    std::printf(
        "RIMLINE {\"version\": \"%s\", \"methods\": {\"OCCT\": {\"ms\": %.3f, \"edges\": %zu, "
        "\"segments\": []}}}\n",
        OCC_VERSION_COMPLETE, took.count(), edges);
    return 0;
}
