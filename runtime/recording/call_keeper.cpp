#include "runtime/recording/call_keeper.h"

#include "runtime/recording/recorder.h"
#include "shaders/shared/pose.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <limits>
#include <set>

namespace supple::runtime {

struct CallKeeper::Told {
    uint64_t sequence = 0;
    std::function<void(Recorder&)> note;
};

void CallKeeper::keepLoad(SuppleAsset asset, std::shared_ptr<const Prepared> version, uint64_t clipPoolBytes) {
    const std::scoped_lock lock(mutex_);
    assets_[asset.id].push_back({++sequence_, std::move(version), clipPoolBytes});
}

void CallKeeper::take(const calls::DestroyAsset& call) {
    destroyedAssets_[call.asset.id] = sequence_;
    forgetUnused();
}

void CallKeeper::take(const calls::CreateView& call) {
    views_[call.view.id] = {sequence_, bytesOf(call)};
}

void CallKeeper::take(const calls::DestroyView& call) {
    destroyedViews_[call.view.id] = sequence_;
    forgetUnused();
}

void CallKeeper::take(const calls::CreateGroup& call) {
    groups_[call.group.id] = {sequence_, bytesOf(call), call.desc.asset.id, call.desc.view.id,
                              call.desc.instancesOf.id};
}

void CallKeeper::take(const calls::DestroyGroup& call) {
    groups_.erase(call.group.id);
    forget({call.group.id});
    forgetUnused();
}

void CallKeeper::take(const calls::CreateQueryPool& call) {
    Pool& pool = pools_[call.pool.id];
    pool = {sequence_, call.desc, {call.desc.groups, call.desc.groups + call.desc.groupCount}};
    pool.desc.groups = nullptr;
}

void CallKeeper::take(const calls::SetTime& call) {
    groups_[call.group.id].time = call.seconds;
}

void CallKeeper::take(const calls::SetMask& call) {
    // It comes where the mask was set first, before the layers that name it.
    const Key key{{call.group.id}, kCallNumber<calls::SetMask>, numberOf(call.group, call.mask.mask)};
    const auto known = calls_.find(key);
    const uint64_t sequence = known != calls_.end() ? known->second.sequence : sequence_;
    put(key, call).sequence = sequence;
}

void CallKeeper::take(const calls::SetTransform& call) {
    forget(ownerOf(call.instance), kCallNumber<calls::SetPosition>);
    putOf(call.instance, call);
}

void CallKeeper::take(const calls::SetJointMatrices& call) {
    if (call.desc.joints == nullptr) {
        putPose(call.instance, call);
        return;
    }
    const Owner owner = ownerOf(call.instance);
    Kept& kept = put({owner, kPose, sequence_}, call);
    kept.joints.assign(call.desc.joints, call.desc.joints + call.desc.jointCount);
    std::sort(kept.joints.begin(), kept.joints.end());
    kept.hasWeights = call.desc.morphWeights != nullptr;
    forgetCovered(owner);
}

void CallKeeper::forgetCovered(const Owner& owner) {
    std::set<uint32_t> covered;
    bool weights = false;
    const auto first = calls_.lower_bound({owner, kPose});
    for (auto kept = calls_.upper_bound({owner, kPose, std::numeric_limits<uint64_t>::max()}); kept != first;) {
        --kept;
        const Kept& one = kept->second;
        if (one.joints.empty()) { // a pose of all joints
            break;
        }
        const bool needed = (one.hasWeights && !weights) ||
                            !std::includes(covered.begin(), covered.end(), one.joints.begin(), one.joints.end());
        covered.insert(one.joints.begin(), one.joints.end());
        weights = weights || one.hasWeights;
        kept = needed ? kept : calls_.erase(kept);
    }
}

void CallKeeper::take(const calls::SetPlayback& call) {
    constexpr uint32_t kPlayback = kCallNumber<calls::SetPlayback>;
    const Owner owner = ownerOf(call.instance);
    const double time = groups_[call.instance.group.id].time.value_or(0.0);
    const bool starts = call.playback.transition > 0.0;
    const bool goesOn = (call.playback.flags & SUPPLE_PLAYBACK_KEEP_TRANSITION) != 0;
    const auto end = calls_.upper_bound({owner, kPlayback, std::numeric_limits<uint64_t>::max()});
    const auto first = calls_.lower_bound({owner, kPlayback});
    std::optional<double> transitionEnd = starts ? std::optional(time + call.playback.transition) : std::nullopt;
    if (first != end) {
        // What a transition starts from is what the calls before have shown, a step before it too. Those before a
        // transition that is over have left nothing of that but the last.
        const auto last = std::prev(end);
        const double before = time - static_cast<double>(shared::kTransitionStep);
        const Kept& shown = last->second;
        const bool over = !shown.transitionEnd || before >= *shown.transitionEnd || time < shown.time;
        if (!starts && goesOn && !over) {
            transitionEnd = shown.transitionEnd;
        }
        const bool tooMany = static_cast<size_t>(std::distance(first, end)) >= kMostPlaybacks;
        if (!starts && (!goesOn || over)) {
            calls_.erase(first, end);
        } else if (over || tooMany) {
            calls_.erase(first, last);
        }
    }
    Kept& kept = put({owner, kPlayback, sequence_}, call);
    kept.time = time;
    kept.transitionEnd = transitionEnd;
}

void CallKeeper::take(const calls::SetModifiers& call) {
    forget(ownerOf(call.instance), kCallNumber<calls::SetModifierTarget>);
    putOf(call.instance, call);
}

void CallKeeper::forget(const Owner& owner) {
    const Owner last = owner.generation != 0 ? owner : Owner{owner.id, UINT32_MAX, UINT32_MAX};
    calls_.erase(calls_.lower_bound({owner}), calls_.upper_bound({last, UINT32_MAX, UINT64_MAX}));
}

void CallKeeper::forget(const Owner& owner, uint32_t call) {
    calls_.erase(calls_.lower_bound({owner, call}), calls_.upper_bound({owner, call, UINT64_MAX}));
}

void CallKeeper::forgetUnused() {
    const auto used = [&](uint64_t Group::*id, uint64_t by) {
        return std::any_of(groups_.begin(), groups_.end(), [&](const auto& group) { return group.second.*id == by; });
    };
    std::erase_if(destroyedAssets_, [&](const auto& asset) {
        return !used(&Group::asset, asset.first) && assets_.erase(asset.first) > 0;
    });
    std::erase_if(destroyedViews_, [&](const auto& view) {
        if (used(&Group::view, view.first)) {
            return false;
        }
        forget({view.first});
        return views_.erase(view.first) > 0;
    });
}

std::vector<CallKeeper::Told> CallKeeper::collect() const {
    std::vector<Told> all;
    for (const auto& [id, versions] : assets_) {
        for (const Version& version : versions) {
            const bool first = &version == versions.data();
            all.push_back({version.sequence, [id = id, first, &version](Recorder& recorder) {
                               const calls::AssetHash hash = recorder.noteAsset(*version.prepared);
                               first ? recorder.note(calls::CreateAsset{{id}, hash, version.clipPoolBytes})
                                     : recorder.note(calls::ReloadAsset{{id}, hash, version.clipPoolBytes});
                               (void)recorder.flush(); // what the host does not take now, it is asked for in the end
                           }});
        }
    }
    const auto add = [&](uint64_t sequence, const std::vector<std::byte>& bytes) {
        all.push_back({sequence, [&bytes](Recorder& recorder) { recorder.noteBytes(bytes); }});
    };
    for (const auto& [id, view] : views_) {
        add(view.sequence, view.bytes);
    }
    for (const auto& [id, sequence] : destroyedAssets_) {
        all.push_back({sequence, [id = id](Recorder& recorder) { recorder.note(calls::DestroyAsset{{id}}); }});
    }
    for (const auto& [id, sequence] : destroyedViews_) {
        all.push_back({sequence, [id = id](Recorder& recorder) { recorder.note(calls::DestroyView{{id}}); }});
    }
    for (const auto& [id, group] : groups_) {
        if (isTold(id)) {
            all.push_back({group.sequence, [this, id = id](Recorder& recorder) { tellGroup(recorder, id); }});
        }
    }
    for (const auto& [id, pool] : pools_) {
        all.push_back({pool.sequence, [this, id = id](Recorder& recorder) { tellPool(recorder, id); }});
    }
    for (const auto& [key, kept] : calls_) {
        if (groups_.contains(key.owner.id) && !isTold(key.owner.id)) {
            continue;
        }
        const bool withGroup =
            key.call == kCallNumber<calls::CreateInstance> || key.call == kCallNumber<calls::SetCapacity>;
        if (kept.transitionEnd) {
            all.push_back({kept.sequence, [id = key.owner.id, time = kept.time](Recorder& recorder) {
                               recorder.note(calls::SetTime{{id}, time});
                           }});
        }
        if (!withGroup) {
            add(kept.sequence, kept.bytes);
        }
    }
    return all;
}

bool CallKeeper::isTold(uint64_t group) const {
    // Once the group whose instances it draws is gone, it can only be destroyed.
    const uint64_t leader = groups_.at(group).leader;
    return leader == 0 || groups_.contains(leader);
}

void CallKeeper::tellGroup(Recorder& recorder, uint64_t id) const {
    recorder.noteBytes(groups_.at(id).bytes);
    if (const auto capacity = calls_.find({{id}, kCallNumber<calls::SetCapacity>}); capacity != calls_.end()) {
        recorder.noteBytes(capacity->second.bytes);
    }
    // An instance gets the lowest free slot: where there is none any more, another one takes the place meanwhile.
    std::vector<SuppleInstance> others;
    uint32_t next = 0;
    for (auto kept = calls_.lower_bound({{id}}); kept != calls_.end() && kept->first.owner.id == id; ++kept) {
        const Owner& owner = kept->first.owner;
        if (kept->first.call != kCallNumber<calls::CreateInstance>) {
            continue;
        }
        for (; next < owner.slot; ++next) {
            others.push_back({{id}, next, 0});
            recorder.note(calls::CreateInstance{others.back()});
        }
        recorder.noteBytes(kept->second.bytes);
        ++next;
    }
    for (const SuppleInstance& other : others) {
        recorder.note(calls::DestroyInstance{other});
    }
}

void CallKeeper::tellPool(Recorder& recorder, uint64_t id) const {
    const Pool& pool = pools_.at(id);
    std::vector<SuppleGroup> told;
    std::copy_if(pool.groups.begin(), pool.groups.end(), std::back_inserter(told),
                 [&](const SuppleGroup& group) { return groups_.contains(group.id) && isTold(group.id); });
    if (told.empty()) {
        return;
    }
    SuppleQueryPoolDesc desc = pool.desc;
    desc.groups = told.data();
    desc.groupCount = static_cast<uint32_t>(told.size());
    recorder.note(calls::CreateQueryPool{{id}, desc});
}

void CallKeeper::tell(Recorder& recorder) {
    const std::scoped_lock lock(mutex_);
    std::vector<Told> all = collect();
    std::stable_sort(all.begin(), all.end(), [](const Told& a, const Told& b) { return a.sequence < b.sequence; });
    for (const Told& told : all) {
        told.note(recorder);
    }
    for (const auto& [id, group] : groups_) {
        if (group.time && isTold(id)) {
            recorder.note(calls::SetTime{{id}, *group.time});
        }
    }
}

} // namespace supple::runtime
