// What the objects of a context were told last, as calls: a recording that begins late starts with them
// (SUPPLE_CONTEXT_RECORDABLE).
#pragma once

#include "runtime/prepared.h"
#include "runtime/recording/calls.h"

#include <compare>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace supple::runtime {

class Recorder;

/// Any threads may use it at the same time.
class CallKeeper {
public:
    /// Keeps a call, and forgets those that it makes up for.
    template <class C>
    void keep(const C& call) {
        const std::scoped_lock lock(mutex_);
        ++sequence_;
        take(call);
    }
    /// An asset has been loaded, for the first time or anew.
    void keepLoad(SuppleAsset asset, std::shared_ptr<const Prepared> version, uint64_t clipPoolBytes);
    /// Notes calls that bring about what there is.
    void tell(Recorder& recorder);

private:
    /// Whose a call is: of an asset, a view or a group, and of an instance of that group.
    struct Owner {
        uint64_t id = 0;
        uint32_t slot = 0, generation = 0;              ///< of an instance; a generation of 0: the group's own
        auto operator<=>(const Owner&) const = default; // NOLINT(modernize-use-nullptr): clang-tidy 14 sees a 0 here
    };
    /// A later call with the same key makes up for an earlier one.
    struct Key {
        Owner owner;
        uint32_t call = 0;  ///< kCallNumber
        uint64_t index = 0; ///< of a part, a mask, ...; of calls that build upon each other, their order
        auto operator<=>(const Key&) const = default; // NOLINT(modernize-use-nullptr): the same
    };
    struct Kept {
        uint64_t sequence = 0;
        std::vector<std::byte> bytes;        ///< number and arguments
        double time = 0.0;                   ///< of SetPlayback: the group's
        std::optional<double> transitionEnd; ///< of SetPlayback: the group's time at which its transition is over
        std::vector<uint32_t> joints;        ///< of SetJointMatrices, if it sets some alone: rising
        bool hasWeights = false;             ///< of SetJointMatrices
    };
    struct Group {
        uint64_t sequence = 0;
        std::vector<std::byte> bytes;
        uint64_t asset = 0, view = 0, leader = 0;
        std::optional<double> time; ///< if it was set
    };
    struct View {
        uint64_t sequence = 0;
        std::vector<std::byte> bytes;
    };
    struct Pool {
        uint64_t sequence = 0;
        SuppleQueryPoolDesc desc{}; ///< without its groups
        std::vector<SuppleGroup> groups;
    };
    /// A version of an asset. Earlier ones stay: poses that were set before the next one name their clips.
    struct Version {
        uint64_t sequence = 0;
        std::shared_ptr<const Prepared> prepared;
        uint64_t clipPoolBytes = 0;
    };
    /// Something to tell at its time.
    struct Told;

    // Everything that is not named here is not kept: frames, and what a frame alone concerns.
    template <class C>
    void take(const C&) {}
    void take(const calls::DestroyAsset& call);
    void take(const calls::CreateView& call);
    void take(const calls::DestroyView& call);
    void take(const calls::CreateGroup& call);
    void take(const calls::DestroyGroup& call);
    void take(const calls::SetCapacity& call) { put({{call.group.id}, kCallNumber<calls::SetCapacity>}, call); }
    void take(const calls::SetRate& call) { put({{call.group.id}, kCallNumber<calls::SetRate>}, call); }
    void take(const calls::SetWind& call) { put({{call.group.id}, kCallNumber<calls::SetWind>}, call); }
    void take(const calls::CreatePointSet& call) {
        put({{call.desc.group.id}, kCallNumber<calls::CreatePointSet>, call.set.id}, call);
    }
    void take(const calls::DestroyPointSet& call) {
        calls_.erase({{call.group.id}, kCallNumber<calls::CreatePointSet>, call.set.id});
    }
    void take(const calls::CreateQueryPool& call);
    void take(const calls::DestroyQueryPool& call) { pools_.erase(call.pool.id); }
    void take(const calls::SetTime& call);
    void take(const calls::SetMask& call);
    void take(const calls::SetCamera& call) { put({{call.view.id}, kCallNumber<calls::SetCamera>}, call); }
    void take(const calls::SetDepthPyramid& call) { put({{call.view.id}, kCallNumber<calls::SetDepthPyramid>}, call); }
    void take(const calls::CreateInstance& call) { putOf(call.instance, call); }
    void take(const calls::DestroyInstance& call) { forget(ownerOf(call.instance)); }
    void take(const calls::SetVisible& call) { putOf(call.instance, call); }
    void take(const calls::SetPartVisible& call) { putOf(call.instance, call, numberOf(call.instance, call.part)); }
    void take(const calls::SetTransform& call);
    void take(const calls::SetPosition& call) { putOf(call.instance, call); }
    void take(const calls::SetUserData& call) { putOf(call.instance, call); }
    void take(const calls::SetSharpness& call) { putOf(call.instance, call, numberOf(call.instance, call.set)); }
    void take(const calls::SetPriority& call) { putOf(call.instance, call); }
    void take(const calls::SetMorphWeights& call) { putOf(call.instance, call); }
    void take(const calls::SetClipPose& call) { putPose(call.instance, call); }
    void take(const calls::SetMatrixPose& call) { putPose(call.instance, call); }
    void take(const calls::SetPose& call) { putPose(call.instance, call); }
    void take(const calls::SetJointMatrices& call);
    void take(const calls::SetPlayback& call);
    void take(const calls::SetModifiers& call);
    void take(const calls::SetModifierTarget& call) { putOf(call.instance, call, numberOf(call.instance, call.index)); }

    [[nodiscard]] static Owner ownerOf(const SuppleInstance& instance) {
        return {instance.group.id, instance.slot, instance.generation};
    }
    template <class C>
    [[nodiscard]] static std::vector<std::byte> bytesOf(const C& call) {
        std::vector<std::byte> bytes;
        CallWriter writer(bytes);
        writer(kCallNumber<C>, call);
        return bytes;
    }
    template <class C>
    Kept& put(const Key& key, const C& call) {
        Kept& kept = calls_[key];
        kept = Kept{sequence_, bytesOf(call)};
        return kept;
    }
    template <class C>
    Kept& putOf(const SuppleInstance& instance, const C& call, uint64_t index = 0) {
        return put({ownerOf(instance), kCallNumber<C>, index}, call);
    }
    /// A number that means something in the present version of the group's asset.
    [[nodiscard]] uint64_t numberOf(SuppleGroup group, uint32_t number) {
        return uint64_t{assets_[groups_[group.id].asset].size()} << 32u | number;
    }
    [[nodiscard]] uint64_t numberOf(const SuppleInstance& instance, uint32_t number) {
        return numberOf(instance.group, number);
    }
    /// Forgets the earlier of those that set some joints, if later ones set all that they set.
    void forgetCovered(const Owner& owner);
    /// Whether the group is told: not if it follows one that is gone.
    [[nodiscard]] bool isTold(uint64_t group) const;
    /// A pose that makes up for all poses before.
    template <class C>
    void putPose(const SuppleInstance& instance, const C& call) {
        forget(ownerOf(instance), kPose);
        put({ownerOf(instance), kPose, sequence_}, call);
    }
    /// Forgets all calls of an owner, with those of a group's instances; or those of one kind.
    void forget(const Owner& owner);
    void forget(const Owner& owner, uint32_t call);
    /// Those that nobody needs any more.
    void forgetUnused();
    [[nodiscard]] std::vector<Told> collect() const;
    void tellGroup(Recorder& recorder, uint64_t id) const;
    /// With those of its groups that are told; not at all without one.
    void tellPool(Recorder& recorder, uint64_t id) const;

    /// Calls of SetPlayback that are kept of an instance whose transitions begin one in the other.
    static constexpr size_t kMostPlaybacks = 16;
    static constexpr uint32_t kPose = kCallNumber<calls::SetPose>; ///< the key of all calls that set poses

    std::mutex mutex_;
    uint64_t sequence_ = 0;
    std::map<Key, Kept> calls_;
    std::map<uint64_t, Group> groups_;
    std::map<uint64_t, View> views_;
    std::map<uint64_t, Pool> pools_;
    std::map<uint64_t, std::vector<Version>> assets_;
    std::map<uint64_t, uint64_t> destroyedAssets_, destroyedViews_; ///< still in use: when they were destroyed
};

} // namespace supple::runtime
