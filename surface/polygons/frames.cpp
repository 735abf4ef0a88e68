#include "surface/polygons/frames.h"

#include "cage/smooth_groups.h"
#include "cage/topology.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace supple::surface::polygons {

namespace {

/// The sum of a group's area vectors is a direction if it is at least so large a part of its areas.
constexpr double kLeastPart = 0.25;
/// An edge gives a tangent if at least so large a part of it lies across the normal.
constexpr double kLeastTangent = 1e-4;

class FrameBuilder {
public:
    explicit FrameBuilder(const cage::Cage& cage) : cage_(cage) {
        for (uint32_t face = 0; face < cage.faceCount(); ++face) {
            cornerFaces_.insert(cornerFaces_.end(), cage.sides(face), face);
            areas_.push_back(areaOf(face));
        }
        out_.cornerFrames.resize(cage.cornerCount());
    }

    Frames build() {
        const std::vector<uint32_t> groups = cage::smoothGroups(cage_);
        std::vector<uint32_t> corners(groups.size());
        std::iota(corners.begin(), corners.end(), 0u);
        std::stable_sort(corners.begin(), corners.end(), [&](uint32_t a, uint32_t b) { return groups[a] < groups[b]; });
        for (size_t first = 0, last = 0; first < corners.size(); first = last) {
            while (last < corners.size() && groups[corners[last]] == groups[corners[first]]) {
                ++last;
            }
            addGroup(std::span(corners).subspan(first, last - first));
        }
        return std::move(out_);
    }

private:
    [[nodiscard]] glm::dvec3 position(uint32_t vertex) const { return cage_.positions[vertex]; }
    [[nodiscard]] const glm::dvec3& areaAt(uint32_t corner) const { return areas_[cornerFaces_[corner]]; }

    /// Twice the area vector.
    [[nodiscard]] glm::dvec3 areaOf(uint32_t face) const {
        const uint32_t* vertices = cage_.faceVertices.data() + cage_.faceStarts[face];
        const glm::dvec3 origin = position(vertices[0]);
        glm::dvec3 area(0.0);
        for (uint32_t k = 1; k + 1 < cage_.sides(face); ++k) {
            area += glm::cross(position(vertices[k]) - origin, position(vertices[k + 1]) - origin);
        }
        return area;
    }

    void addGroup(std::span<const uint32_t> corners) {
        glm::dvec3 sum(0.0);
        double whole = 0.0;
        for (const uint32_t corner : corners) {
            sum += areaAt(corner);
            whole += glm::length(areaAt(corner));
        }
        if (corners.size() == 1 || glm::length(sum) > kLeastPart * whole) {
            addFrame(corners, corners);
            return;
        }
        const uint32_t largest = *std::max_element(corners.begin(), corners.end(), [&](uint32_t a, uint32_t b) {
            return glm::length(areaAt(a)) < glm::length(areaAt(b));
        });
        for (const uint32_t& corner : corners) {
            const bool flat = glm::length(areaAt(corner)) == 0.0;
            addFrame({&corner, 1}, flat ? std::span(&largest, 1) : std::span(&corner, 1));
        }
    }

    /// The frame of `corners`, which turns with the faces of the corners `by`.
    void addFrame(std::span<const uint32_t> corners, std::span<const uint32_t> by) {
        const auto number = static_cast<uint32_t>(out_.frames.size());
        for (const uint32_t corner : corners) {
            out_.cornerFrames[corner] = number;
        }
        const uint32_t vertex = cage_.faceVertices[by.front()];
        Frame& frame = out_.frames.emplace_back(Frame{vertex, vertex, static_cast<uint32_t>(out_.faces.size())});
        glm::dvec3 sum(0.0);
        for (const uint32_t corner : by) {
            sum += areaAt(corner);
        }
        const double area = glm::length(sum);
        if (!(area > 0.0) || !chooseTangent(by, sum / area, frame)) {
            return; // that of the axes
        }
        for (const uint32_t corner : by) {
            out_.faces.push_back(cornerFaces_[corner]);
        }
        frame.faceCount = static_cast<uint32_t>(by.size());
    }

    /// Along the edge of the group that lies best across the normal; of several the first.
    bool chooseTangent(std::span<const uint32_t> by, const glm::dvec3& normal, Frame& frame) const {
        double best = kLeastTangent;
        for (const uint32_t corner : by) {
            const uint32_t face = cornerFaces_[corner];
            for (const uint32_t other :
                 {cage::nextCorner(cage_, face, corner), cage::previousCorner(cage_, face, corner)}) {
                const glm::dvec3 edge = position(cage_.faceVertices[other]) - position(frame.vertex);
                const glm::dvec3 across = edge - glm::dot(edge, normal) * normal;
                const double length = glm::length(across), part = length / glm::length(edge);
                if (part > best * (1.0 + 1e-9)) {
                    best = part;
                    frame.toward = cage_.faceVertices[other];
                    frame.axes = {across / length, glm::cross(normal, across / length), normal};
                }
            }
        }
        return best > kLeastTangent;
    }

    const cage::Cage& cage_;
    std::vector<uint32_t> cornerFaces_;
    std::vector<glm::dvec3> areas_;
    Frames out_;
};

} // namespace

Frames makeFrames(const cage::Cage& cage) {
    return FrameBuilder(cage).build();
}

} // namespace supple::surface::polygons
