#include "runtime/asset_match.h"

#include <map>
#include <string>
#include <utility>

namespace supple::runtime {

namespace {

using Names = std::vector<std::string>;

/// By place in `wanted`: the place of the same name in `names`, or kNone.
std::vector<uint32_t> findNames(const Names& wanted, const Names& names) {
    std::map<std::pair<std::string, uint32_t>, uint32_t> places;
    std::map<std::string, uint32_t> counts;
    for (uint32_t i = 0; i < names.size(); ++i) {
        places[{names[i], counts[names[i]]++}] = i;
    }
    counts.clear();
    std::vector<uint32_t> found;
    for (const std::string& name : wanted) {
        const auto at = places.find({name, counts[name]++});
        found.push_back(at != places.end() ? at->second : cage::kNone);
    }
    return found;
}

Names partNames(const cage::Character& character) {
    Names names;
    for (const cage::Part& part : character.parts) {
        names.push_back(part.name);
    }
    return names;
}

Names nodeNames(const cage::Character& character) {
    Names names;
    for (const cage::Node& node : character.skeleton.nodes) {
        names.push_back(node.name);
    }
    return names;
}

Names jointNames(const cage::Character& character) {
    Names names;
    for (const uint32_t node : character.skin.joints) {
        names.push_back(character.skeleton.nodes[node].name);
    }
    return names;
}

Names clipNames(const cage::Character& character) {
    Names names;
    for (const cage::Clip& clip : character.clips) {
        names.push_back(clip.name);
    }
    return names;
}

/// With the name of the first part that has them.
Names targetNames(const cage::Character& character) {
    Names names(character.morphs.targets.size());
    for (auto part = character.parts.rbegin(); part != character.parts.rend(); ++part) {
        for (uint32_t t = part->firstTarget; t < part->firstTarget + part->targetCount; ++t) {
            names[t] = part->name + '\n' + character.morphs.targets[t].name;
        }
    }
    return names;
}

} // namespace

AssetMatch AssetMatch::of(const cage::Character& before, const cage::Character& now) {
    AssetMatch match;
    match.same = false;
    match.parts = findNames(partNames(now), partNames(before));
    match.joints = findNames(jointNames(now), jointNames(before));
    match.targets = findNames(targetNames(now), targetNames(before));
    match.creaseSets = findNames(now.cage.creaseSets, before.cage.creaseSets);
    match.clips = findNames(clipNames(before), clipNames(now));
    match.nodes = findNames(nodeNames(before), nodeNames(now));
    return match;
}

} // namespace supple::runtime
