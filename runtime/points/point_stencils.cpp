#include "runtime/points/point_stencils.h"

#include "runtime/cpu_group.h"
#include "shaders/shared/points.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>

namespace supple::runtime {
namespace {

/// A share that is smaller than this, beside the largest of its kind, is what rounding has left of a sum.
constexpr double kNoShare = 1e-11;
/// Where du and dv are parallel in the bind pose, the frame is that of a place so far on the way to the middle.
constexpr double kInside = 1e-3;

/// What a vertex has of a point's position, and of its tangent and bitangent carried along.
struct Share {
    uint32_t vertex = 0;
    double position = 0.0, a = 0.0, b = 0.0;
};

/// Derivatives in the bind pose.
struct BindFrame {
    glm::dvec3 du{0.0}, dv{0.0}, normal{0.0}; ///< the normal: of unit length, or zero if there is none
};
BindFrame bindFrame(const cpu::PointWeights& weights, const cage::Cage& cage) {
    BindFrame frame;
    const glm::dvec3 first(cage.positions[weights.entries()[0].vertex]);
    for (const cpu::VertexWeight& entry : weights.entries()) {
        const glm::dvec3 p = glm::dvec3(cage.positions[entry.vertex]) - first;
        frame.du += entry.du * p;
        frame.dv += entry.dv * p;
    }
    const glm::dvec3 normal = glm::cross(frame.du, frame.dv);
    const double length = glm::length(normal);
    if (length > 1e-9 * glm::length(frame.du) * glm::length(frame.dv)) {
        frame.normal = normal / length;
    }
    return frame;
}

/// `from` in the plane of the frame, of unit length. Without one, along du.
glm::dvec3 tangentIn(const BindFrame& frame, const glm::dvec3& from) {
    const glm::dvec3 flat = from - glm::dot(from, frame.normal) * frame.normal;
    const double length = glm::length(flat);
    return length > 1e-6 * glm::length(from) ? flat / length : glm::normalize(frame.du);
}

/// Blocks of points are packed as they are full, so that what a point has in double does not stay.
class StencilTable {
public:
    StencilTable(const CpuGroup& group, size_t pointCount, std::span<const float> tangents, bool derivatives,
                 uint64_t mostElements)
        : group_(group), tangents_(tangents), derivatives_(derivatives), mostElements_(mostElements),
          blocks_((pointCount + shared::kPointBlock - 1) / shared::kPointBlock), words_(4 * blocks_) {}

    /// Adds the next point.
    Status add(const SuppleSurfacePoint& point) {
        if (Status weighed = weigh(point); !weighed) {
            const Error& error = weighed.error();
            return Error{error.code, "points[" + std::to_string(added_) + "], face " + std::to_string(point.face) +
                                         ": " + error.message};
        }
        ++added_;
        return starts_.size() == shared::kPointBlock ? pack() : success();
    }
    /// The table's words, when all points are added.
    Result<std::vector<uint32_t>> finish() {
        if (Status packed = starts_.empty() ? success() : pack(); !packed) {
            return packed.error();
        }
        return std::move(words_);
    }

private:
    Status weigh(const SuppleSurfacePoint& point) {
        const CpuGroup::Found found = group_.find(point);
        if (found.place.fault != nullptr) {
            return Error{ErrorCode::range, found.place.fault};
        }
        const CpuGroup::Part& part = group_.parts()[found.part];
        const cpu::PointWeights position = weightsAt(part, found.place.place);
        const cpu::PointWeights beside =
            found.place.held ? weightsAt(part, found.place.beside) : cpu::PointWeights(position);
        const BindFrame frame = bindFrame(beside, group_.cage());
        if (frame.normal != glm::dvec3(0.0) || derivatives_) {
            return put(position, beside, frame);
        }
        const CpuGroup::Found inside = group_.find(inwards(point));
        const cpu::PointWeights near = weightsAt(group_.parts()[inside.part], inside.place.place);
        return put(position, near, bindFrame(near, group_.cage()));
    }
    /// By vertex of the whole cage.
    static cpu::PointWeights weightsAt(const CpuGroup::Part& part, const cpu::Place& place) {
        cpu::PointWeights weights;
        part.surface->weigh(place, weights);
        if (part.piece != nullptr) {
            for (cpu::VertexWeight& entry : weights.entries()) {
                entry.vertex = part.piece->of.vertices[entry.vertex];
            }
        }
        return weights;
    }
    [[nodiscard]] SuppleSurfacePoint inwards(const SuppleSurfacePoint& point) const {
        const uint32_t sides = group_.cage().sides(point.face);
        const double middle = sides == 4 ? 0.5 : 1.0 / 3.0;
        const auto moved = [&](float from) { return static_cast<float>(from + kInside * (middle - from)); };
        return {point.face, point.side, moved(point.a), moved(point.b)};
    }

    /// `beside`: where derivatives come from.
    Status put(const cpu::PointWeights& position, const cpu::PointWeights& beside, const BindFrame& frame) {
        const size_t first = shares_.size(), point = added_;
        starts_.push_back(first);
        // The tangent and the bitangent as combinations of du and dv.
        glm::dvec2 ofTangent(0.0), ofBitangent(0.0);
        if (derivatives_) {
            ofTangent = {1.0, 0.0};
            ofBitangent = {0.0, 1.0};
        } else if (frame.normal != glm::dvec3(0.0)) { // else there is none to carry along
            const glm::dvec3 given = tangents_.empty() ? glm::dvec3(0.0)
                                                       : glm::dvec3(tangents_[3 * point], tangents_[3 * point + 1],
                                                                    tangents_[3 * point + 2]);
            const glm::dvec3 tangent = tangentIn(frame, given);
            const double e = glm::dot(frame.du, frame.du), f = glm::dot(frame.du, frame.dv),
                         g = glm::dot(frame.dv, frame.dv);
            const glm::dvec3 normal = glm::cross(frame.du, frame.dv);
            const double area = glm::dot(normal, normal); // e g - f f, without its cancellation
            const auto solve = [&](const glm::dvec3& v) {
                const double u = glm::dot(v, frame.du), w = glm::dot(v, frame.dv);
                return glm::dvec2(g * u - f * w, e * w - f * u) / area;
            };
            ofTangent = solve(tangent);
            ofBitangent = solve(glm::cross(frame.normal, tangent));
        }
        for (const cpu::VertexWeight& entry : position.entries()) {
            shares_.push_back({entry.vertex, entry.position});
        }
        for (const cpu::VertexWeight& entry : beside.entries()) {
            shares_.push_back({entry.vertex, 0.0, ofTangent.x * entry.du + ofTangent.y * entry.dv,
                               ofBitangent.x * entry.du + ofBitangent.y * entry.dv});
        }
        finish(first);
        const size_t count = shares_.size() - first;
        return count <= kMostPointVertices ? success()
                                           : Status(Error{ErrorCode::limit, "it hangs on " + std::to_string(count) +
                                                                                " vertices of the cage: the most is " +
                                                                                std::to_string(kMostPointVertices)});
    }
    /// Sums up the shares of each vertex, leaves out what is nothing, and puts the heaviest vertex first.
    void finish(size_t first) {
        const auto begin = shares_.begin() + static_cast<ptrdiff_t>(first);
        std::stable_sort(begin, shares_.end(), [](const Share& x, const Share& y) { return x.vertex < y.vertex; });
        auto last = begin;
        for (auto share = begin + 1; share != shares_.end(); ++share) {
            if (share->vertex == last->vertex) {
                last->position += share->position, last->a += share->a, last->b += share->b;
            } else {
                *++last = *share;
            }
        }
        shares_.erase(last + 1, shares_.end());
        double position = 0.0, slope = 0.0;
        for (auto share = begin; share != shares_.end(); ++share) {
            position = std::max(position, std::abs(share->position));
            slope = std::max({slope, std::abs(share->a), std::abs(share->b)});
        }
        shares_.erase(std::remove_if(begin, shares_.end(),
                                     [&](const Share& share) {
                                         return std::abs(share.position) <= kNoShare * position &&
                                                std::abs(share.a) <= kNoShare * slope &&
                                                std::abs(share.b) <= kNoShare * slope;
                                     }),
                      shares_.end());
        const auto heaviest = std::max_element(begin, shares_.end(),
                                               [](const Share& x, const Share& y) { return x.position < y.position; });
        std::rotate(begin, heaviest, heaviest + 1);
    }
    /// Writes the block in hand.
    Status pack() {
        size_t longest = 0;
        for (size_t point = 0; point < starts_.size(); ++point) {
            longest = std::max(longest, sharesOf(point).size());
        }
        const size_t before = words_.size() / 4, elements = before + longest * starts_.size();
        if (elements > mostElements_) {
            return Error{ErrorCode::limit, "the weights of the first " + std::to_string(added_) + " points are " +
                                               std::to_string(elements) + " elements: the most is " +
                                               std::to_string(mostElements_)};
        }
        const uint32_t header[4] = {static_cast<uint32_t>(before), static_cast<uint32_t>(longest),
                                    static_cast<uint32_t>(starts_.size()), 0};
        std::copy_n(header, 4, words_.begin() + static_cast<ptrdiff_t>(4 * ((added_ - 1) / shared::kPointBlock)));
        for (size_t i = 0; i < longest; ++i) {
            for (size_t point = 0; point < starts_.size(); ++point) {
                const std::span<const Share> shares = sharesOf(point);
                putShare(i < shares.size() ? shares[i] : Share{shares[0].vertex}, words_);
            }
        }
        starts_.clear();
        shares_.clear();
        return success();
    }
    [[nodiscard]] std::span<const Share> sharesOf(size_t point) const {
        const size_t end = point + 1 < starts_.size() ? starts_[point + 1] : shares_.size();
        return std::span(shares_).subspan(starts_[point], end - starts_[point]);
    }
    static void putShare(const Share& share, std::vector<uint32_t>& words) {
        const auto bits = [](double value) { return std::bit_cast<uint32_t>(static_cast<float>(value)); };
        words.insert(words.end(), {share.vertex, bits(share.position), bits(share.a), bits(share.b)});
    }

    const CpuGroup& group_;
    std::span<const float> tangents_;
    bool derivatives_;
    uint64_t mostElements_;
    size_t blocks_, added_ = 0;
    std::vector<uint32_t> words_; ///< a header for each block, then their weights
    // What the block that is being filled has:
    std::vector<size_t> starts_; ///< by point, into shares_
    std::vector<Share> shares_;
};

} // namespace

Result<std::shared_ptr<const CpuGroup>> surfacesOf(std::shared_ptr<const Prepared> prepared,
                                                   const SuppleGroupDesc& desc) {
    // Of tables only the patches matter: those of the plainest are enough.
    SuppleGroupDesc plain = desc;
    plain.flags = 0;
    plain.uvInterpolation = {};
    return CpuGroup::create(std::move(prepared), plain);
}

Result<std::vector<uint32_t>> pointTable(const CpuGroup& group, std::span<const SuppleSurfacePoint> points,
                                         std::span<const float> tangents, bool derivatives, uint64_t mostElements) {
    StencilTable table(group, points.size(), tangents, derivatives, mostElements);
    for (const SuppleSurfacePoint& point : points) {
        if (Status added = table.add(point); !added) {
            return added.error();
        }
    }
    return table.finish();
}

} // namespace supple::runtime
