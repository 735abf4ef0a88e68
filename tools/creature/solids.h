// Solids to model with: tubes laid ring by ring, sheets, strands, straps, boxes. All are closed and their faces have
// texture coordinates, in metres.
#pragma once

#include "mixing.h"
#include "modeller.h"

#include <functional>
#include <vector>

namespace supple::creature {

// A tube that grows by rings. On a half model its rings run from the middle of the front to the middle of the back.
class Tube {
public:
    Tube(Cage& cage, const Patch& start) : end(start), cage(cage) { rims.push_back(Cage::rimOf(start)); }

    // A shell of its own; the first ring is its closed beginning.
    static Tube begin(Cage& cage, int columns, int rows, const Frame& frame, double across, double along,
                      bool half = false);

    void ring(const Frame& frame, double across, double along, double dome = 0);
    // Texture coordinates for all walls since the beginning; `v` is where they start.
    void lay(double v = 0) const;

    Patch end;
    std::vector<std::vector<int>> rims;
    std::vector<std::vector<int>> levels; // all points of each ring

private:
    Cage& cage;
    bool fresh = false; // the first ring after begin() is there already
};

// Points evenly along a smooth curve through `through`.
std::vector<Vec3> spline(const std::vector<Vec3>& through, int count);

using Surface = std::function<Vec3(double, double)>;
// A sheet of the given thickness below a surface over [0, 1]^2; its upper side looks along d/du x d/dv.
struct Sheet {
    Patch top;
    Patch bottom;
};
Sheet sheet(Cage& cage, int columns, int rows, const Surface& surface, double thickness);
// Makes the rim of a sheet crisp.
void creaseSheet(Cage& cage, const Sheet& made, float sharpness);

// A lock, flat or round, that runs along a path; `up` is what its flat side looks to at each place.
struct LockRing {
    Vec3 at;
    Vec3 up;
    double wide = 0;
    double thick = 0;
};
void lock(Cage& cage, const std::vector<LockRing>& rings);

// A strap along a path: `out` is where its face looks at each place. Closed ones meet their beginning.
struct StrapPoint {
    Vec3 at;
    Vec3 out;
};
void strap(Cage& cage, const std::vector<StrapPoint>& path, double wide, double thick, bool closed,
           float sharpness = 3);

// A ring of tube with a round section of `sides` points round each place of a closed path.
void torus(Cage& cage, const std::vector<StrapPoint>& path, int sides, const std::function<Vec2(size_t, int)>& section);

// A box with rounded edges; the frame is its middle.
void box(Cage& cage, const Frame& frame, const Vec3& size, float sharpness = 2);

// A button: a dome on the frame.
void stud(Cage& cage, const Frame& frame, double radius, double height);

// Moves the points so that the limit surface goes where they were.
void fitLimits(Cage& cage, const std::function<bool(size_t)>& chosen, int rounds = 6);

// Draws each point towards the middle of its neighbors by its share.
void relax(Cage& cage, const std::vector<double>& shares, int rounds);

// A cage's limit points as a surface of flat faces, to lay things on.
class Body {
public:
    explicit Body(const Cage& cage) : cage(cage), limits(cage.limits()) {}
    // Where a ray meets it first and where it faces there; the ray's origin if it misses.
    StrapPoint cast(const Vec3& from, const Vec3& along) const;

private:
    Cage cage;
    std::vector<Vec3> limits;
};

// Joins a cage to another, its shells numbered anew.
void append(Cage& cage, const Cage& more);
// The same reflected in x = 0.
Cage reflected(const Cage& cage);

} // namespace supple::creature
