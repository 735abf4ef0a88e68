// A program lists every dispatch of the surface passes for one set of tables. It is made once; recording walks it and
// decides nothing.
#pragma once

#include "gpu/dispatches.h"
#include "shaders/shared/lod.h"
#include "shaders/shared/window.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace supple::surface {

/// The kinds of descriptor sets that surface passes bind. Each kind has its own layout (Programs::layout), so that no
/// layout has more bindings than its passes use.
enum class SetKind : uint32_t {
    construct,      ///< vertex, assemble, patch
    evaluate,       ///< evaluate and motion at a rate
    subdivide,      ///< the same of fragments, and of the vertices of polygons
    evaluateLevels, ///< evaluate and motion at the levels of a view
    attributes,     ///< at a rate and at levels
    levels,         ///< level, solve, place
    count
};
inline constexpr size_t kSetKinds = static_cast<size_t>(SetKind::count);
using Sets = std::array<gpu::BoundSet, kSetKinds>;

/// Instances that one descriptor set of each kind reaches, and what shaders are told about them.
struct Window {
    Sets sets{};
    shared::WindowPush push{};
    /// Null if the host knows the number of instances. Otherwise the device writes the sizes of dispatches into this
    /// buffer: step i of a pass (Step::argument) reads three words at firstArgument + i * argumentStride bytes.
    VkBuffer arguments = VK_NULL_HANDLE;
    VkDeviceSize firstArgument = 0;
    VkDeviceSize argumentStride = sizeof(VkDispatchIndirectCommand);
};

/// How a dispatch depends on the dispatch before it in the same pass. That one may belong to the window before.
enum class Order : uint32_t {
    free,     ///< they share nothing: no barrier
    shared,   ///< they write into the words of the view, and so do other groups: gpu::disjointBarrier between any two
    disjoint, ///< they share buffers, but touch different elements (gpu::disjointBarrier)
    after     ///< it reads what the other one wrote (gpu::computeBarrier)
};

/// How large a dispatch is: `elements` per instance, and perGroup of all elements per workgroup.
struct DispatchSize {
    uint32_t elements = 0; ///< lanes, patches or fragments
    uint32_t perGroup = 1;

    /// One workgroup, however many instances there are. If there are none, it writes that there are none.
    [[nodiscard]] static constexpr DispatchSize oneGroup() { return {1, 0}; }
    [[nodiscard]] constexpr bool isOneGroup() const { return perGroup == 0; }
};

/// One dispatch per window.
struct Step {
    gpu::Kernel kernel;
    SetKind sets = SetKind::construct;
    Order order = Order::free;
    DispatchSize size;     ///< has at least one element
    uint32_t argument = 0; ///< its number among the window's arguments; a step of one workgroup has none
    /// The push constants. They begin with shared::WindowPush, which recording fills in.
    std::array<std::byte, gpu::kPushConstantBytes> push{};
    uint32_t pushBytes = 0;

    template <class Push>
    void setPush(const Push& constants) {
        static_assert(offsetof(Push, window) == 0 && sizeof(Push) <= gpu::kPushConstantBytes);
        static_assert(std::is_same_v<decltype(Push::window), shared::WindowPush>);
        std::memcpy(push.data(), &constants, sizeof(constants));
        pushBytes = sizeof(constants);
    }
};
using Steps = std::vector<Step>;

/// Groups share the barriers inside of a pass: it is recorded in rounds. In a round are, of every group, the steps that
/// wait for nothing but the barriers behind the rounds before.
struct Round {
    gpu::Dispatches& dispatches;
    uint32_t number = 0;
    Order next = Order::free; ///< what the steps of the next round ask for; free: nobody has one

    /// Goes on to the next round, with the barrier before it. False if there is none.
    [[nodiscard]] bool advance();
};

/// Calls record(round) for every round that there is.
template <class Record>
void inRounds(gpu::Dispatches& dispatches, Record&& record) {
    Round round{dispatches};
    do {
        record(round);
    } while (round.advance());
}

/// Records the steps of a round. Allocates nothing.
void record(Round& round, std::span<const Step> steps, const Window& window);

/// Records all steps in order. Before each comes the barrier that its order asks for; only patchLevels and places begin
/// with one. Allocates nothing.
void record(gpu::Dispatches& dispatches, std::span<const Step> steps, const Window& window);

/// Between passes the caller records a barrier from compute writes to compute reads. The order is vertex, assemble,
/// levels, deepen, evaluate, motion. `patch` may come at any time after assemble, and `attributes` at any time after
/// places.
struct Program {
    Steps vertex;     ///< output: limit points, tangents, ...
    Steps assemble;   ///< coefficients that need the output of `vertex`
    Steps patch;      ///< output: the coefficients of each patch, for inspection
    Steps attributes; ///< at a rate: for a single instance, once. At levels: for every window in every frame
    Steps evaluate;
    Steps motion; ///< positions alone, from the coefficients of the frame before
    // Groups with levels. The push constants are shared::LodPush; setCamera() fills in what changes in every frame.
    // patchLevels, depths and places are of one round each.
    Steps edgeLevels; ///< empty if an instance has one level (ProgramOptions::levelOffset)
    Steps patchLevels;
    Steps depths; ///< which instances need which levels of chains, before places
    Steps places;
    Steps deepen; ///< coefficients that the levels ask for. Sizes are in the scratch of a window's first instance, from
                  ///< word firstDepthDispatch on, by Step::argument
    uint32_t firstDepthDispatch = 0;
    uint32_t scratchStride = 0; ///< elements per instance in the scratch buffer; a multiple of 256 bytes

    void setCamera(const shared::LodCamera& camera);

    /// The sizes of the steps of vertex, assemble, edgeLevels, patchLevels and places, indexed by Step::argument. They
    /// are constructions in the order of the tables, then edges and patches by kind, then all patches.
    [[nodiscard]] std::vector<DispatchSize> constructionSizes() const;
    /// How many of these are of vertex and assemble: the first ones.
    [[nodiscard]] uint32_t constructionCount() const;
    /// The same of evaluate; motion has the same sizes. For groups whose instances have rates of their own.
    [[nodiscard]] std::vector<DispatchSize> evaluationSizes() const;
};

} // namespace supple::surface
