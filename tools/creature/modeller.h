// Modelling by extruding grids of quads, which keeps the cage all-quad, and by the operations that end this: fans,
// dissolved loops, openings. All keep it oriented.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <map>
#include <utility>
#include <vector>

namespace supple::creature {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;
using Quat = glm::dquat;

constexpr double kPi = 3.14159265358979323846;

// What a point or a face belongs to; weights, paint and charts are decided by it.
enum class Part {
    Torso,
    Belly, // the mixed variant's plate
    Head,
    Mouth,
    Lid,
    Ear,
    Arm,
    Thumb,
    Finger1,
    Finger2,
    Finger3,
    Finger4,
    Web, // faces only: their points are the hand's and the foot's
    Leg,
    Foot,
    Tail,
    TailFin,
    Wing,
    Eye,
    EyeShine,
    Nostril,
    Tongue,
    Tooth,
    Horn,
    Claw,
    Spike,
    // Wren's alone.
    Lip,
    Lash,
    Brow,
    Hand,
    Nail,
    Hair,
    Ribbon,
    Jacket,
    JacketTrim,
    Collar,
    Trousers,
    KneePatch,
    Boot,
    BootCuff,
    Sole,
    Strap,
    Buckle,
    Pouch,
    Bracer,
    Pauldron,
    Scarf,
    ScarfFringe,
    Blade,
    Guard,
    Grip,
    Scabbard,
};

struct Point {
    Vec3 position{0};
    Part part = Part::Torso;
    int shell = 0;    // 0 is the body; each detail shell has its own number
    double jaw = 0;   // share of the head's weight that follows the jaw
    double upper = 0; // share that follows the upper lid
    double lower = 0; // share that follows the lower lid
    double along = 0; // free parameter for painting: position along a fin, angle on an eyeball
    double rib = 0;   // share of a wing's bone in its membrane, for painting
};

struct Face {
    std::vector<int> points;
    Part part = Part::Torso;
    std::vector<Vec2> uvs = {}; // one a point, in metres, or none: charts are made later
};

// A grid of columns x rows quads inside a cage, known by its points. On a half model, a patch that touches the mirror
// plane has its column 0 there and stands for twice its width.
struct Patch {
    int columns = 0;
    int rows = 0;
    bool half = false;
    std::vector<int> points;

    int at(int column, int row) const { return points[static_cast<size_t>(row * (columns + 1) + column)]; }
};

// Right-handed: across x along = out.
struct Frame {
    Vec3 origin{0};
    Vec3 across{1, 0, 0};
    Vec3 along{0, 1, 0};
    Vec3 out{0, 0, 1};
};

// A frame looking down `out`, with `across` as near to `hint` as possible.
Frame frameFrom(const Vec3& origin, const Vec3& out, const Vec3& hint);

struct Cage {
    std::vector<Point> points;
    std::vector<Face> faces;
    std::map<std::pair<int, int>, float> creases; // by points, the smaller first; sharpness as in cage::Crease
    Part part = Part::Torso;                      // given to whatever is made next
    int shell = 0;
    int shells = 0;

    Vec3& position(int point) { return points[static_cast<size_t>(point)].position; }
    const Vec3& position(int point) const { return points[static_cast<size_t>(point)].position; }

    int addPoint(const Vec3& position);
    void addQuad(int a, int b, int c, int d);

    // Two coincident grids back to back, sharing their points; extruding the returned one opens them into a solid.
    Patch seed(int columns, int rows, bool half, Patch& underside);

    // The quads between points given row by row must exist.
    Patch patch(int columns, int rows, bool half, const std::vector<int>& grid) const;

    // Lifts the patch off the cage on a wall of new quads; the new points start where the old ones are.
    Patch extrude(const Patch& patch);

    // Puts the patch's rim evenly on an ellipse and its inside over the disk, bulging by `dome`.
    void placeDisk(const Patch& patch, const Frame& frame, double radiusAcross, double radiusAlong, double dome = 0);

    // The one cell of a patch as a patch of its own.
    Patch cell(const Patch& patch, int column, int row) const;

    // A detached closed shell of columns x rows tube; returns the end patch to extrude further.
    Patch beginShell(int columns, int rows, const Frame& frame, double radiusAcross, double radiusAlong, double dome);
    void endShell() { shell = 0; }

    // What lies along the rim of a patch, counter-clockwise from its first point; on a half model from plane to plane.
    static std::vector<int> rimOf(const Patch& patch);

    // Instead of the patch's faces, triangles from its rim to one new point at `tip`.
    int fan(const Patch& patch, const Vec3& tip);

    // Takes the patch's faces away.
    void open(const Patch& patch);

    // Takes away the edges between consecutive points, and those of the points that then have only two edges.
    void dissolve(const std::vector<int>& chain);

    // Opens the edge a-b into a strip `width` wide, which runs out in a triangle at each end: at `before` on a's side
    // and at `after` on b's.
    void widen(int before, int a, int b, int after, double width);

    void crease(int a, int b, float sharpness);
    void creaseChain(const std::vector<int>& chain, float sharpness);

    // Reflects the half model in x = 0 and welds it there.
    void mirror();
    // Drops points no face uses.
    void compact();

    // Where the surface meets each point: Catmull-Clark's limit on quads, P_m's on all faces. Creases do not count.
    std::vector<Vec3> limits() const;

    std::vector<std::vector<int>> neighbours() const;
    // The face on the left of each edge.
    std::map<std::pair<int, int>, size_t> directedEdges() const;
    // Twice the face's area long.
    Vec3 normal(const Face& face) const;
    Vec3 centre(const Face& face) const;

private:
    int findQuad(const std::array<int, 4>& corners) const;
    // The face that runs from a to b.
    size_t faceAlong(int a, int b) const;
};

// Whether some two points are so close that a reader could weld them.
bool hasCoincidentPoints(const Cage& cage);

} // namespace supple::creature
