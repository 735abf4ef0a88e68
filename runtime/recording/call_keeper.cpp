#include "runtime/recording/call_keeper.h"

#include "runtime/recording/recorder.h"

#include <algorithm>
#include <functional>
#include <limits>

namespace supple::runtime {

struct CallKeeper::Told {
    uint64_t sequence = 0;
    std::function<void(Recorder&)> note;
};

void CallKeeper::keepLoad(SuppleAsset asset, std::shared_ptr<const Prepared> version) {
    const std::scoped_lock lock(mutex_);
    assets_[asset.id].push_back({++sequence_, std::move(version)});
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

void CallKeeper::take(const calls::SetTime& call) {
    groups_[call.group.id].time = call.seconds;
}

void CallKeeper::take(const calls::SetMask& call) {
    // It comes where the mask was set first, before the layers that name it. Another version of the asset has other
    // joints.
    const uint64_t versions = assets_[groups_[call.group.id].asset].size();
    const Key key{{call.group.id}, kCallNumber<calls::SetMask>, versions << 32u | call.mask.mask};
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
    std::vector<uint32_t> joints(call.desc.joints, call.desc.joints + call.desc.jointCount);
    const Owner owner = ownerOf(call.instance);
    const auto end = calls_.upper_bound({owner, kPose, std::numeric_limits<uint64_t>::max()});
    for (auto kept = calls_.lower_bound({owner, kPose}); kept != end;) {
        kept = kept->second.joints == joints ? calls_.erase(kept) : std::next(kept);
    }
    put({owner, kPose, sequence_}, call).joints = std::move(joints);
}

void CallKeeper::take(const calls::SetPlayback& call) {
    constexpr uint32_t kPlayback = kCallNumber<calls::SetPlayback>;
    const Owner owner = ownerOf(call.instance);
    const double time = groups_[call.instance.group.id].time;
    const bool starts = call.playback.transition > 0.0;
    const bool goesOn = (call.playback.flags & SUPPLE_PLAYBACK_KEEP_TRANSITION) != 0;
    const auto end = calls_.upper_bound({owner, kPlayback, std::numeric_limits<uint64_t>::max()});
    const auto first = calls_.lower_bound({owner, kPlayback});
    double transitionEnd = starts ? time + call.playback.transition : 0.0;
    if (first != end) {
        // What a transition starts from is what the calls before have shown. Those before a transition that is over
        // have left nothing of that but the last.
        const auto last = std::prev(end);
        const bool over = !(time < last->second.transitionEnd && time >= last->second.time);
        transitionEnd = !starts && goesOn && !over ? last->second.transitionEnd : transitionEnd;
        if (!starts && (!goesOn || over)) {
            calls_.erase(first, end);
        } else if (over) {
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
                               first ? recorder.note(calls::CreateAsset{{id}, hash})
                                     : recorder.note(calls::ReloadAsset{{id}, hash});
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
        // Once the group whose instances it draws is gone, it can only be destroyed.
        if (group.leader == 0 || groups_.contains(group.leader)) {
            all.push_back({group.sequence, [this, id = id](Recorder& recorder) { tellGroup(recorder, id); }});
        }
    }
    for (const auto& [key, kept] : calls_) {
        const bool withGroup =
            key.call == kCallNumber<calls::CreateInstance> || key.call == kCallNumber<calls::SetCapacity>;
        if (kept.transitionEnd != 0.0) {
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

void CallKeeper::tell(Recorder& recorder) {
    const std::scoped_lock lock(mutex_);
    std::vector<Told> all = collect();
    std::stable_sort(all.begin(), all.end(), [](const Told& a, const Told& b) { return a.sequence < b.sequence; });
    for (const Told& told : all) {
        told.note(recorder);
    }
    for (const auto& [id, group] : groups_) {
        if (group.time != 0.0) {
            recorder.note(calls::SetTime{{id}, group.time});
        }
    }
}

} // namespace supple::runtime
