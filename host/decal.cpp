#include "host/decal.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace supple::host {

namespace {

constexpr float kSteepest = 80.0f; ///< degrees: what is steeper is seen as a line
constexpr int kHalvings = 6;       ///< that find the border between two nodes
/// Between its corners a patch may be off by this part of its size. Where it is off by more, there is a gap.
constexpr float kGap = 0.6f;
/// The part of the depth beyond which the picture fades out.
constexpr float kDepthFade = 0.75f;

glm::vec3 vectorOf(const float (&v)[3]) {
    return {v[0], v[1], v[2]};
}

Status checkDesc(const DecalDesc& desc) {
    const auto isLength = [](float x) { return x >= 0.0f && x <= SUPPLE_MAX_COORDINATE; };
    if (!isLength(desc.size.x) || !isLength(desc.size.y) || desc.size.x == 0.0f || desc.size.y == 0.0f)
        return Error{ErrorCode::argument, "decal: its size must be above 0 and finite"};
    if (!isLength(desc.depth))
        return Error{ErrorCode::argument, "decal: its depth must be finite, and 0 or more"};
    if (!(desc.fadeBegin >= 0.0f && desc.fadeBegin < desc.fadeEnd && desc.fadeEnd <= kSteepest))
        return Error{ErrorCode::argument, "decal: fadeBegin must be below fadeEnd, and that at most 80 degrees"};
    if (desc.segments < 2 || desc.segments > 128)
        return Error{ErrorCode::argument, "decal: segments must be 2 to 128"};
    if (!std::isfinite(desc.rotation) || !(glm::length(desc.up) < SUPPLE_MAX_COORDINATE))
        return Error{ErrorCode::argument, "decal: rotation and up must be finite"};
    return success();
}

/// A node of the grid over the picture, or a place between two of them. `x` and `y` lie in the tangent plane of the
/// picture's middle, `height` above it.
struct Node {
    bool isFound = false;
    float x = 0.0f, y = 0.0f, height = 0.0f;
    glm::vec3 normal{0.0f}; ///< in the plane's axes: right, up, outwards
    float bend = 0.0f;      ///< along the normal: Decal::bend
    SuppleSurfacePoint point{};
};

/// A node that the surface may be followed to: from one where it was found.
struct Step {
    const Node* from = nullptr;
    float x = 0.0f, y = 0.0f;
};

class Projection {
public:
    Projection(SuppleContext context, SuppleGroup group, const DecalDesc& desc)
        : context_(context), group_(group), desc_(desc) {
        const float longer = std::max(desc.size.x, desc.size.y);
        const auto along = [&](float size) {
            const auto half = std::lround(0.5f * static_cast<float>(desc.segments) * size / longer);
            return 2 * static_cast<uint32_t>(std::max(half, 1l)); // so that the middle is a node
        };
        columns_ = along(desc.size.x);
        rows_ = along(desc.size.y);
        depth_ = desc.depth > 0.0f ? desc.depth : 0.5f * glm::length(desc.size);
        nodes_.resize(size_t{columns_ + 1} * (rows_ + 1));
    }

    [[nodiscard]] Result<Decal> run() {
        Status status = place();
        if (status)
            status = spread();
        if (status)
            status = findBorder();
        if (!status)
            return status.error();
        return patches();
    }

private:
    [[nodiscard]] Node& node(uint32_t i, uint32_t j) { return nodes_[size_t{j} * (columns_ + 1) + i]; }
    [[nodiscard]] float xOf(uint32_t i) const {
        return (static_cast<float>(i) / static_cast<float>(columns_) - 0.5f) * desc_.size.x;
    }
    [[nodiscard]] float yOf(uint32_t j) const {
        return (static_cast<float>(j) / static_cast<float>(rows_) - 0.5f) * desc_.size.y;
    }

    [[nodiscard]] Status ask(SupplePointQueryKind kind, std::span<const float> values,
                             std::vector<SuppleSurfacePoint>& points, std::vector<SuppleSurfaceJet>& jets) const {
        jets.resize(points.size());
        SupplePointQuery query{};
        query.structSize = sizeof query;
        query.kind = kind;
        query.count = static_cast<uint32_t>(points.size());
        query.values = values.empty() ? nullptr : values.data();
        query.jets = jets.data();
        const SuppleResult result = suppleFindPoints(context_, group_, &query, points.data());
        return result == SUPPLE_OK
                   ? success()
                   : Status(Error{ErrorCode::argument, "decal: suppleFindPoints refuses its points; the log says why"});
    }

    /// The plane of the picture, and its middle.
    [[nodiscard]] Status place() {
        std::vector<SuppleSurfacePoint> point{desc_.at};
        std::vector<SuppleSurfaceJet> jet;
        if (Status given = ask(SUPPLE_FIND_GIVEN, {}, point, jet); !given)
            return given;
        const glm::vec3 du = vectorOf(jet[0].du), across = glm::cross(du, vectorOf(jet[0].dv));
        if (!(glm::length(across) > 0.0f))
            return Error{ErrorCode::argument, "decal: the surface has no tangent plane at its middle"};
        origin_ = vectorOf(jet[0].position);
        outwards_ = glm::normalize(across);
        glm::vec3 up = desc_.up - outwards_ * glm::dot(outwards_, desc_.up);
        up = glm::normalize(glm::length(up) > 1e-4f * glm::length(desc_.up) ? up : du);
        const glm::vec3 right = glm::cross(up, outwards_);
        right_ = std::cos(desc_.rotation) * right + std::sin(desc_.rotation) * up;
        up_ = glm::cross(outwards_, right_);
        node(columns_ / 2, rows_ / 2) = {true,    0.0f, 0.0f, 0.0f, {0.0f, 0.0f, 1.0f}, bendOf(jet[0], outwards_),
                                         desc_.at};
        return success();
    }

    /// Where the surface would be at the end of a step if it went on as it does at its beginning, and how far it may be
    /// off: it may bend to the steepest slope.
    [[nodiscard]] static float guess(const Step& step) {
        const glm::vec3& n = step.from->normal;
        return step.from->height - (n.x * (step.x - step.from->x) + n.y * (step.y - step.from->y)) / n.z;
    }
    [[nodiscard]] float allowance(const Step& step) const {
        const float length = glm::length(glm::vec2(step.x - step.from->x, step.y - step.from->y));
        return length * std::tan(glm::radians(desc_.fadeEnd)) + 1e-6f * (std::abs(step.from->height) + desc_.size.x);
    }

    /// What the ends of steps meet.
    [[nodiscard]] Result<std::vector<Node>> follow(const std::vector<Step>& steps) const {
        std::vector<float> rays;
        for (const Step& step : steps) {
            const glm::vec3 origin =
                origin_ + step.x * right_ + step.y * up_ + (guess(step) + allowance(step)) * outwards_;
            rays.insert(rays.end(), {origin.x, origin.y, origin.z, -outwards_.x, -outwards_.y, -outwards_.z});
        }
        std::vector<SuppleSurfacePoint> points(steps.size());
        std::vector<SuppleSurfaceJet> jets;
        if (Status found = ask(SUPPLE_FIND_RAY, rays, points, jets); !found)
            return found.error();
        std::vector<Node> met;
        for (size_t k = 0; k < steps.size(); ++k)
            met.push_back(points[k].face == SUPPLE_NO_FACE ? Node{} : nodeAt(steps[k], points[k], jets[k]));
        return met;
    }
    [[nodiscard]] Node nodeAt(const Step& step, const SuppleSurfacePoint& point, const SuppleSurfaceJet& jet) const {
        const glm::vec3 across = glm::cross(vectorOf(jet.du), vectorOf(jet.dv));
        const float area = glm::length(across);
        const float height = glm::dot(vectorOf(jet.position) - origin_, outwards_);
        if (!(area > 0.0f) || std::abs(height - guess(step)) > allowance(step) || std::abs(height) > depth_)
            return {};
        const glm::vec3 normal =
            glm::vec3(glm::dot(across, right_), glm::dot(across, up_), glm::dot(across, outwards_)) / area;
        if (normal.z < std::cos(glm::radians(desc_.fadeEnd)))
            return {};
        return {true, step.x, step.y, height, normal, bendOf(jet, across / area), point};
    }

    [[nodiscard]] static float bendOf(const SuppleSurfaceJet& jet, const glm::vec3& normal) {
        const auto along = [&](const float(&v)[3]) { return std::abs(glm::dot(vectorOf(v), normal)); };
        return along(jet.duu) + 2.0f * along(jet.duv) + along(jet.dvv);
    }

    /// Calls visit(i, j) for the neighbors of a node along the grid's lines.
    template <class F>
    void forEachBeside(uint32_t i, uint32_t j, F&& visit) const {
        if (i > 0)
            visit(i - 1, j);
        if (i < columns_)
            visit(i + 1, j);
        if (j > 0)
            visit(i, j - 1);
        if (j < rows_)
            visit(i, j + 1);
    }

    /// From the middle on, to all nodes that the surface leads to.
    [[nodiscard]] Status spread() {
        std::vector<glm::uvec2> front{{columns_ / 2, rows_ / 2}};
        while (!front.empty()) {
            std::vector<glm::uvec2> ends;
            std::vector<Step> steps;
            for (const glm::uvec2& at : front) {
                forEachBeside(at.x, at.y, [&](uint32_t i, uint32_t j) {
                    if (node(i, j).isFound)
                        return;
                    ends.emplace_back(i, j);
                    steps.push_back({&node(at.x, at.y), xOf(i), yOf(j)});
                });
            }
            if (steps.empty())
                break;
            const Result<std::vector<Node>> met = follow(steps);
            if (!met)
                return met.error();
            front.clear();
            for (size_t k = 0; k < ends.size(); ++k) {
                Node& end = node(ends[k].x, ends[k].y);
                if (!(*met)[k].isFound || end.isFound)
                    continue;
                end = (*met)[k];
                front.push_back(ends[k]);
            }
        }
        return success();
    }

    /// Nodes beside found ones come to where the surface ends, so that its border is no staircase.
    [[nodiscard]] Status findBorder() {
        struct Border {
            Node* end = nullptr;
            Node inside;              ///< the last place that was found
            float x = 0.0f, y = 0.0f; ///< the first that was not
        };
        std::vector<Border> borders;
        for (uint32_t j = 0; j <= rows_; ++j) {
            for (uint32_t i = 0; i <= columns_; ++i) {
                if (node(i, j).isFound)
                    continue;
                const Node* beside = nullptr; // that nearest to the middle
                forEachBeside(i, j, [&](uint32_t k, uint32_t l) {
                    const Node& other = node(k, l);
                    const auto away = [](const Node& n) { return n.x * n.x + n.y * n.y; };
                    if (other.isFound && (beside == nullptr || away(other) < away(*beside)))
                        beside = &other;
                });
                if (beside != nullptr)
                    borders.push_back({&node(i, j), *beside, xOf(i), yOf(j)});
            }
        }
        for (int round = 0; round < kHalvings && !borders.empty(); ++round) {
            std::vector<Step> steps;
            for (const Border& border : borders)
                steps.push_back(
                    {&border.inside, 0.5f * (border.inside.x + border.x), 0.5f * (border.inside.y + border.y)});
            const Result<std::vector<Node>> met = follow(steps);
            if (!met)
                return met.error();
            for (size_t k = 0; k < borders.size(); ++k) {
                if ((*met)[k].isFound) {
                    borders[k].inside = (*met)[k];
                } else {
                    borders[k].x = steps[k].x;
                    borders[k].y = steps[k].y;
                }
            }
        }
        for (const Border& border : borders)
            *border.end = border.inside;
        return success();
    }

    /// The middles of patches say whether there is a gap between the corners, and how far the surface bulges there.
    [[nodiscard]] Result<Decal> patches() {
        std::vector<std::vector<const Node*>> corners;
        std::vector<Step> middles;
        for (uint32_t j = 0; j < rows_; ++j) {
            for (uint32_t i = 0; i < columns_; ++i) {
                std::vector<const Node*> own;
                glm::vec2 middle(0.0f);
                for (const Node* corner : {&node(i, j), &node(i + 1, j), &node(i + 1, j + 1), &node(i, j + 1)}) {
                    if (!corner->isFound)
                        continue;
                    own.push_back(corner);
                    middle += glm::vec2(corner->x, corner->y);
                }
                if (own.size() < 3)
                    continue;
                middle /= static_cast<float>(own.size());
                middles.push_back({own[0], middle.x, middle.y});
                corners.push_back(std::move(own));
            }
        }
        if (corners.empty())
            return Error{ErrorCode::argument, "decal: the surface is smaller than one of its patches"};
        const Result<std::vector<Node>> met = follow(middles);
        if (!met)
            return met.error();
        Decal decal;
        std::vector<uint32_t> numbers(nodes_.size(), UINT32_MAX);
        for (size_t k = 0; k < corners.size(); ++k) {
            const std::optional<float> bulge = bulgeOf(corners[k], (*met)[k]);
            if (!bulge)
                continue;
            Decal::Patch patch{};
            for (size_t c = 0; c < patch.size(); ++c) {
                patch[c] = numberOf(*corners[k][std::min(c, corners[k].size() - 1)], numbers, decal);
                float& sag = decal.places[patch[c]].sag;
                sag = std::max(sag, *bulge);
            }
            decal.patches.push_back(patch);
        }
        if (decal.patches.empty())
            return Error{ErrorCode::argument, "decal: the surface is smaller than one of its patches"};
        decal.bend = mostBend();
        return decal;
    }
    /// That of nearly all nodes: beside extraordinary vertices it has no limit.
    [[nodiscard]] float mostBend() const {
        std::vector<float> bends;
        for (const Node& own : nodes_) {
            if (own.isFound)
                bends.push_back(own.bend);
        }
        const auto most = bends.begin() + static_cast<ptrdiff_t>(bends.size() * 9 / 10);
        std::nth_element(bends.begin(), most, bends.end());
        return *most;
    }
    /// How far the surface lies above its corners' mean; none: there is a gap.
    [[nodiscard]] std::optional<float> bulgeOf(const std::vector<const Node*>& corners, const Node& middle) const {
        if (!middle.isFound)
            return std::nullopt;
        float mean = 0.0f;
        for (const Node* corner : corners)
            mean += corner->height / static_cast<float>(corners.size());
        const float off = std::abs(middle.height - mean);
        const float size = desc_.size.x / static_cast<float>(columns_) + desc_.size.y / static_cast<float>(rows_);
        return off <= kGap * size ? std::optional(off * middle.normal.z) : std::nullopt;
    }
    [[nodiscard]] uint32_t numberOf(const Node& node, std::vector<uint32_t>& numbers, Decal& decal) const {
        uint32_t& number = numbers[static_cast<size_t>(&node - nodes_.data())];
        if (number != UINT32_MAX)
            return number;
        number = static_cast<uint32_t>(decal.points.size());
        decal.points.push_back(node.point);
        decal.tangents.push_back(right_);
        decal.places.push_back({node.x / desc_.size.x + 0.5f, 0.5f - node.y / desc_.size.y, opacityOf(node), 0.0f});
        return number;
    }
    [[nodiscard]] float opacityOf(const Node& node) const {
        const auto fade = [](float x, float begin, float end) {
            const float t = std::clamp((x - begin) / (end - begin), 0.0f, 1.0f);
            return 1.0f - t * t * (3.0f - 2.0f * t);
        };
        const float angle = glm::degrees(std::acos(std::clamp(node.normal.z, -1.0f, 1.0f)));
        return fade(angle, desc_.fadeBegin, desc_.fadeEnd) * fade(std::abs(node.height), kDepthFade * depth_, depth_);
    }

    SuppleContext context_;
    SuppleGroup group_;
    const DecalDesc& desc_;
    uint32_t columns_ = 0, rows_ = 0;
    float depth_ = 0.0f;
    glm::vec3 origin_{0.0f}, right_{0.0f}, up_{0.0f}, outwards_{0.0f};
    std::vector<Node> nodes_; ///< row by row from the lower left
};

} // namespace

std::vector<uint32_t> Decal::indices() const {
    std::vector<uint32_t> list;
    for (const Patch& p : patches)
        list.insert(list.end(), {p[0], p[1], p[2], p[0], p[2], p[3]});
    return list;
}

Result<Decal> projectDecal(SuppleContext context, SuppleGroup group, const DecalDesc& desc) {
    if (const Status status = checkDesc(desc); !status)
        return status.error();
    return Projection(context, group, desc).run();
}

} // namespace supple::host
