#include "skinning/cloth_table.h"

#include "cage/message.h"
#include "cage/soft.h"
#include "shaders/shared/pose.h"
#include "shaders/shared/soft.h"
#include "skinning/bits.h"
#include "skinning/cloth_mesh.h"
#include "skinning/cloth_twin.h"
#include "skinning/jiggle_table.h"
#include "skinning/pose.h"
#include "skinning/soft_nodes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <optional>
#include <queue>
#include <string>

namespace supple::skinning {
namespace {

using namespace shared;
using cage::kNone;
using Pair = ClothPairs::Pair;

static_assert(cage::kMaxClothColliders == kMostClothColliders);

constexpr double kMass = 0.01; // of a vertex of weight 1, in kg
constexpr double kLeastClothWeight = 1e-3;
constexpr double kVolumeGives = 0.05;    // beside what vertices give in the rest pose
constexpr uint32_t kSettlingSteps = 240; // four seconds
constexpr uint32_t kLanes = 32;          // that a workgroup has at least
constexpr uint32_t kVolumeRounds = 64;   // of trees and leaves

/// The spring that a cloth is where it is light: it loses its speed as the cloth does, but swings at most a few times.
glm::vec4 lightSpring(float drag) {
    const double lost = -std::log(std::max(1.0 - static_cast<double>(drag), 1e-9)) * kStepsASecond;
    const double damping = lost / (4.0 * glm::pi<double>() * static_cast<double>(kLightClothFrequency));
    return jiggleSpring(
        {.frequency = kLightClothFrequency, .damping = std::max(static_cast<float>(damping), kLeastLightDamping)});
}

struct Constraint {
    Pair pair;
    double length = 0.0, compliance = 0.0;
    uint32_t color = 0;
};
struct Tether {
    uint32_t anchor = kClothFree;
    double length = 0.0;
};

class ClothBuilder {
public:
    ClothBuilder(const cage::Character& character, uint32_t cloth, const ClothMesh& mesh, ClothTable& table)
        : character_(character), own_(character.cloths[cloth]), mesh_(mesh), pairs_(clothPairs(mesh)), table_(table) {
        for (const uint32_t v : mesh.vertices) {
            const cage::PaintedWeight& painted = character.weights.cloths[v];
            positions_.emplace_back(character.cage.positions[v]);
            mobility_.push_back(painted.index == cloth
                                    ? std::max(static_cast<double>(painted.weight), kLeastClothWeight) / kMass
                                    : 0.0);
        }
        findConstraints();
        findTethers();
        for (size_t f = 0; own_.volume && f < mesh.faceCount(); ++f) {
            for (uint32_t c = mesh.faceStarts[f] + 1; c + 1 < mesh.faceStarts[f + 1]; ++c) {
                const uint32_t first = mesh.faceVertices[mesh.faceStarts[f]];
                triangles_.push_back({first, mesh.faceVertices[c], mesh.faceVertices[c + 1]});
            }
        }
    }

    /// `head`: where the cloth's record stands.
    void put(uint32_t head) {
        putVertices(head);
        putColors(head);
        if (own_.volume) {
            putVolume(head);
        }
        putColliders(head);
        putNumbers(head);
        table_.stateElements += kClothVertices + stateElements() * count();
    }

    /// Rounds that a lane goes in its loops in a step, at most. `deform`: of each vertex of the cage.
    [[nodiscard]] uint32_t work(const std::vector<uint32_t>& deform) const {
        std::array<uint32_t, kLanes> deformed{}, faces{};
        for (uint32_t i = 0; i < count(); ++i) {
            deformed[i % kLanes] += deform[mesh_.vertices[i]] + 2;
        }
        for (const std::array<uint32_t, 3>& triangle : triangles_) {
            for (const uint32_t vertex : triangle) {
                ++faces[vertex % kLanes];
            }
        }
        uint32_t substep = roundsOf(count()) * (2 + countOf(own_.colliders)) + roundsOf(countOf(triangles_)) +
                           *std::max_element(faces.begin(), faces.end()) + (own_.volume ? kVolumeRounds : 0);
        for (const uint32_t size : colorSizes()) {
            substep += 1 + roundsOf(size);
        }
        return own_.substeps * substep + *std::max_element(deformed.begin(), deformed.end());
    }

private:
    template <class T>
    [[nodiscard]] static uint32_t countOf(const std::vector<T>& list) {
        return static_cast<uint32_t>(list.size());
    }
    [[nodiscard]] uint32_t count() const { return countOf(mesh_.vertices); }
    [[nodiscard]] uint32_t stateElements() const { return kClothElements + (own_.volume ? 1 : 0); }
    [[nodiscard]] uint32_t next() const { return countOf(table_.words) / 4; }
    [[nodiscard]] static uint32_t roundsOf(uint32_t items) { return (items + kLanes - 1) / kLanes; }
    [[nodiscard]] double substep() const { return 1.0 / (kStepsASecond * own_.substeps); }
    [[nodiscard]] double apart(uint32_t a, uint32_t b) const { return glm::distance(positions_[a], positions_[b]); }
    static uint32_t word(double value) { return bits(static_cast<float>(value)); }

    void put(const std::array<uint32_t, 4>& element) {
        table_.words.insert(table_.words.end(), element.begin(), element.end());
    }
    void put(const glm::dvec3& v, double w) { put({word(v.x), word(v.y), word(v.z), word(w)}); }
    void set(uint32_t element, const std::array<uint32_t, 4>& words) {
        std::copy(words.begin(), words.end(), table_.words.begin() + 4 * static_cast<ptrdiff_t>(element));
    }

    /// Colors are greedy, in the order of the list: the first that neither end has.
    void findConstraints() {
        const auto add = [&](const std::vector<Pair>& pairs, float compliance) {
            for (const Pair& pair : pairs) {
                constraints_.push_back({pair, apart(pair[0], pair[1]), static_cast<double>(compliance), 0});
            }
        };
        add(pairs_.edges, own_.stretch);
        add(pairs_.diagonals, own_.shear);
        add(pairs_.bends, own_.bend);
        std::vector<std::vector<bool>> used(count());
        for (Constraint& constraint : constraints_) {
            std::vector<bool>&a = used[constraint.pair[0]], &b = used[constraint.pair[1]];
            const auto has = [&](const std::vector<bool>& of) {
                return constraint.color < of.size() && of[constraint.color];
            };
            while (has(a) || has(b)) {
                ++constraint.color;
            }
            for (std::vector<bool>* const of : {&a, &b}) {
                of->resize(std::max<size_t>(of->size(), constraint.color + 1));
                (*of)[constraint.color] = true;
            }
            colorCount_ = std::max(colorCount_, constraint.color + 1);
        }
        std::stable_sort(constraints_.begin(), constraints_.end(),
                         [](const Constraint& a, const Constraint& b) { return a.color < b.color; });
    }
    [[nodiscard]] std::vector<uint32_t> colorSizes() const {
        std::vector<uint32_t> sizes(colorCount_, 0);
        for (const Constraint& constraint : constraints_) {
            ++sizes[constraint.color];
        }
        return sizes;
    }

    /// By the shortest way over edges and diagonals to a vertex that hangs (Kim, Chentanez, Mueller: Long Range
    /// Attachments, SCA 2012).
    void findTethers() {
        tethers_.resize(count());
        if (own_.tether == 0.0f) {
            return;
        }
        std::vector<std::vector<uint32_t>> neighbours(count());
        for (const std::vector<Pair>* const pairs : {&pairs_.edges, &pairs_.diagonals}) {
            for (const Pair& pair : *pairs) {
                neighbours[pair[0]].push_back(pair[1]);
                neighbours[pair[1]].push_back(pair[0]);
            }
        }
        using Reached = std::pair<double, uint32_t>;
        std::priority_queue<Reached, std::vector<Reached>, std::greater<>> queue;
        for (uint32_t i = 0; i < count(); ++i) {
            const bool hangs = i < mesh_.hangingCount;
            tethers_[i] = {hangs ? i : kClothFree, hangs ? 0.0 : std::numeric_limits<double>::infinity()};
            if (hangs) {
                queue.emplace(0.0, i);
            }
        }
        while (!queue.empty()) {
            const auto [way, at] = queue.top();
            queue.pop();
            for (const uint32_t other : neighbours[at]) {
                const double length = way + apart(at, other);
                if (way <= tethers_[at].length && length < tethers_[other].length) {
                    tethers_[other] = {tethers_[at].anchor, length};
                    queue.emplace(length, other);
                }
            }
        }
    }

    void putVertices(uint32_t head) {
        set(head, {count(), mesh_.hangingCount, next(), stateElements()});
        for (uint32_t i = 0; i < count(); ++i) {
            const Tether& tether = tethers_[i];
            const bool isTethered = i >= mesh_.hangingCount && tether.anchor != kClothFree;
            put({mesh_.vertices[i], word(mobility_[i]), isTethered ? tether.anchor : kClothFree,
                 word(isTethered ? tether.length * static_cast<double>(own_.tether) : 0.0)});
            put({0u, 0u, 0u, 0u});
            put({0u, 0u, 0u, 0u});
        }
    }
    void putColors(uint32_t head) {
        const uint32_t colors = next();
        set(head + 1, {colorCount_, colors, 0u, 0u});
        uint32_t first = colors + colorCount_;
        for (const uint32_t size : colorSizes()) {
            put({first, first + size, 0u, 0u});
            first += size;
        }
        for (const Constraint& own : constraints_) {
            const double sum = mobility_[own.pair[0]] + mobility_[own.pair[1]];
            put({own.pair[0], own.pair[1], word(own.length),
                 word(1.0 / (sum + own.compliance / (substep() * substep())))});
        }
    }
    void putVolume(uint32_t head) {
        std::vector<std::vector<Pair>> around(count());
        const uint32_t faces = next();
        for (const auto& [i, j, k] : triangles_) {
            put({i, j, k, 0u});
            around[i].push_back({j, k});
            around[j].push_back({k, i});
            around[k].push_back({i, j});
            const glm::dvec3 o = positions_[0];
            volume_ += glm::dot(positions_[i] - o, glm::cross(positions_[j] - o, positions_[k] - o));
        }
        table_.words[4 * size_t{head + 1} + 2] = countOf(triangles_);
        table_.words[4 * size_t{head + 1} + 3] = faces;
        const uint32_t vertices = table_.words[4 * size_t{head} + 2];
        for (uint32_t i = 0; i < count(); ++i) {
            const uint32_t first = next();
            for (const Pair& pair : around[i]) {
                put({pair[0], pair[1], 0u, 0u});
            }
            set(vertices + kClothVertexElements * i + 2, {first, next(), 0u, 0u});
        }
    }

    /// The sum of the squares of what vertices change of six times the volume, by their mobility.
    [[nodiscard]] double volumeGradient() const {
        std::vector<glm::dvec3> gradients(count(), glm::dvec3(0.0));
        for (const auto& [i, j, k] : triangles_) {
            const glm::dvec3 o = positions_[0], a = positions_[i] - o, b = positions_[j] - o, c = positions_[k] - o;
            gradients[i] += glm::cross(b, c);
            gradients[j] += glm::cross(c, a);
            gradients[k] += glm::cross(a, b);
        }
        double sum = 0.0;
        for (uint32_t i = 0; i < count(); ++i) {
            sum += mobility_[i] * glm::dot(gradients[i], gradients[i]);
        }
        return sum;
    }

    /// The joint of the skin that a node is or hangs on, and where that node lies in the bind pose.
    struct Held {
        uint32_t joint = kClothFree;
        glm::dmat4 bind{1.0};
    };
    [[nodiscard]] Held heldBy(uint32_t node) const {
        Held held;
        for (; node != kNone; node = character_.skeleton.nodes[node].parent) {
            const std::vector<uint32_t>& joints = character_.skin.joints;
            const auto found = std::find(joints.begin(), joints.end(), node);
            if (found != joints.end()) {
                held.joint = static_cast<uint32_t>(found - joints.begin());
                held.bind = glm::inverse(glm::dmat4(character_.skin.inverseBinds[held.joint])) * held.bind;
                break;
            }
            const cage::Node& own = character_.skeleton.nodes[node];
            held.bind = glm::dmat4(localMatrix(own, restTransform(own))) * held.bind;
        }
        return held;
    }
    void putColliders(uint32_t head) {
        set(head + 2, {countOf(own_.colliders), next(), own_.substeps, table_.stateElements});
        for (const uint32_t collider : own_.colliders) {
            const cage::SpringCollider& from = character_.springBones.colliders[collider];
            const Held held = heldBy(from.node);
            const bool plane = from.shape == cage::ColliderShape::plane;
            put({held.joint, (from.inside && !plane ? kColliderInside : 0u) | (plane ? kColliderPlane : 0u), 0u, 0u});
            const glm::dvec3 tail(from.shape == cage::ColliderShape::sphere ? from.offset : from.tail);
            put(glm::dvec3(held.bind * glm::dvec4(glm::dvec3(from.offset), 1.0)), static_cast<double>(from.radius));
            put(plane ? glm::dmat3(held.bind) * glm::normalize(tail) : glm::dvec3(held.bind * glm::dvec4(tail, 1.0)),
                0.0);
        }
    }

    void putNumbers(uint32_t head) {
        std::vector<double> lengths;
        for (const Pair& pair : pairs_.edges) {
            lengths.push_back(apart(pair[0], pair[1]));
        }
        std::sort(lengths.begin(), lengths.end());
        const double median = lengths.empty() ? 0.0 : lengths[lengths.size() / 2], h = substep();
        const auto kept = [&](float lost) { return std::pow(1.0 - static_cast<double>(lost), kStepsASecond * h); };
        set(head + 3, {word(h), word(kept(own_.drag)), word(1.0 - kept(own_.air)), word(0.25 * median)});
        set(head + 4, {word(1.0 / h), word(static_cast<double>(own_.gravity) * h), word(volume_),
                       word(kVolumeGives * volumeGradient())});
        set(head + 5, {bits(own_.hitRadius), 0u, 0u, 0u});
        const glm::vec4 spring = lightSpring(own_.drag);
        set(head + 6, {bits(spring.x), bits(spring.y), bits(spring.z), bits(spring.w)});
    }

    const cage::Character& character_;
    const cage::Cloth& own_;
    const ClothMesh& mesh_;
    ClothPairs pairs_;
    ClothTable& table_;
    std::vector<glm::dvec3> positions_;
    std::vector<double> mobility_; ///< inverse masses
    std::vector<Constraint> constraints_;
    uint32_t colorCount_ = 0;
    std::vector<Tether> tethers_;
    std::vector<std::array<uint32_t, 3>> triangles_; ///< of faces, if their volume is kept
    double volume_ = 0.0;                            ///< six times
};

/// Hangs cloths in the rest pose for some seconds, and writes where they have come to rest.
void settle(const cage::Character& character, ClothTable& table) {
    ClothTwin twin(table);
    std::vector<glm::vec4> state(table.stateElements, glm::vec4(0.0f)), goals;
    for (const glm::vec3& position : character.cage.positions) {
        goals.emplace_back(position, 1.0f);
    }
    for (uint32_t cloth = 0; cloth < table.clothCount; ++cloth) {
        ClothTwin::Step now;
        for (uint32_t n = 0; n < kSettlingSteps; ++n) {
            now.settles = n == 0;
            twin.step(cloth, goals, {}, now, state);
        }
        for (uint32_t i = 0; i < twin.vertexCount(cloth); ++i) {
            const glm::vec3 offset = twin.offset(cloth, i, state);
            uint32_t* const words = &table.words[4 * size_t{twin.vertexElement(cloth, i) + 1}];
            for (int k = 0; k < 3; ++k) {
                words[k] = bits(offset[k]);
            }
        }
    }
}

std::optional<Error> faultOf(uint32_t cloth, const ClothMesh& mesh) {
    if (mesh.vertices.size() > kMostClothVertices) {
        return Error{ErrorCode::limit, cage::at("cloth", cloth) + " has " + std::to_string(mesh.vertices.size()) +
                                           " vertices, with those that it hangs on, of at most " +
                                           std::to_string(kMostClothVertices)};
    }
    return std::nullopt;
}

} // namespace

Result<ClothTable> buildClothTable(const cage::Character& character) {
    ClothTable table;
    const std::vector<ClothMesh> meshes = clothMeshes(character);
    table.clothCount = static_cast<uint32_t>(meshes.size());
    table.words.resize(4 * kClothHeadElements * meshes.size(), 0u);
    const std::vector<uint32_t> deform = deformWork(character);
    for (uint32_t cloth = 0; cloth < table.clothCount; ++cloth) {
        if (const std::optional<Error> fault = faultOf(cloth, meshes[cloth])) {
            return *fault;
        }
        ClothBuilder builder(character, cloth, meshes[cloth], table);
        const uint32_t work = builder.work(deform);
        if (work > kMostStepWork) {
            return Error{ErrorCode::limit, cage::at("cloth", cloth) + " takes " + std::to_string(work) +
                                               " rounds of constraints in a step, of at most " +
                                               std::to_string(kMostStepWork)};
        }
        builder.put(kClothHeadElements * cloth);
    }
    settle(character, table);
    return table;
}

} // namespace supple::skinning
