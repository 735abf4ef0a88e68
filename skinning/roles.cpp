#include "skinning/roles.h"

#include "cage/skeleton.h"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <iterator>
#include <utility>
#include <vector>

namespace supple::skinning {
namespace {

using cage::kNone;

constexpr const char* kPartNames[kParts] = {"hips", "neck",     "head",     "thigh",    "shin", "foot",
                                            "toes", "clavicle", "upperarm", "lowerarm", "hand"};

/// What a part is called, in small letters and without digits. Names of `weak` mean it only where no other node has one
/// of those before: a leg is a thigh above a knee, and a shin below an upper leg.
struct Synonyms {
    std::initializer_list<std::string_view> strong, weak;
};
const Synonyms kSynonyms[kParts] = {
    {{"hips", "pelvis"}, {"hip"}},
    {{"neck"}, {"necklower"}},
    {{"head"}, {}},
    {{"thigh", "upperleg", "upleg", "legupper", "thighbend"}, {"leg", "hip", "femur"}},
    {{"shin", "calf", "lowerleg", "lowleg", "leglower"}, {"leg", "knee"}},
    {{"foot"}, {"ankle"}},
    {{"toes", "toe", "ball", "toebase"}, {}},
    {{"clavicle", "shoulder", "collar"}, {}},
    {{"upperarm", "uparm", "armupper", "shldrbend", "shldr"}, {"arm", "shoulder"}},
    {{"lowerarm", "lowarm", "forearm", "armlower", "forearmbend"}, {"elbow", "arm"}},
    {{"hand"}, {"palm", "wrist"}},
};
/// Words that rigs put in front of all names.
constexpr std::string_view kPrefixes[] = {"bip",   "biped", "j",          "c",         "def", "b",    "bn",  "jnt",
                                          "joint", "bone",  "valvebiped", "mixamorig", "cc",  "base", "bind"};
constexpr size_t kLongestName = 128;   ///< longer ones have no role
constexpr size_t kMostCandidates = 64; ///< for a role: so that no file makes the search long

bool isDigit(char c) {
    return c >= '0' && c <= '9';
}
bool isLower(char c) {
    return c >= 'a' && c <= 'z';
}
bool isUpper(char c) {
    return c >= 'A' && c <= 'Z';
}
std::string lowered(std::string_view text) {
    std::string lower(text);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](char c) { return isUpper(c) ? static_cast<char>(c - 'A' + 'a') : c; });
    return lower;
}
std::string_view withoutDigits(std::string_view word) {
    while (!word.empty() && isDigit(word.back())) {
        word.remove_suffix(1);
    }
    return word;
}

/// What a name says: its words in small letters without the side, and the side.
struct NameParts {
    std::vector<std::string> words;
    std::optional<size_t> side;
};

std::optional<size_t> sideOfWord(const std::string& lower) {
    if (lower == "l" || lower == "left") {
        return kLeft;
    }
    return lower == "r" || lower == "right" ? std::optional(kRight) : std::nullopt;
}

/// "LeftUpLeg", "lThigh", "thighL": the side is a part of the word, which loses it.
std::optional<size_t> takeSide(std::string& word) {
    const std::string lower = lowered(word);
    constexpr std::pair<std::string_view, size_t> kSides[] = {{"left", kLeft}, {"right", kRight}};
    for (const auto& [text, side] : kSides) {
        if (const size_t found = lower.find(text); found != std::string::npos) {
            word.erase(found, text.size());
            return side;
        }
    }
    if (word.size() < 3) {
        return std::nullopt;
    }
    if ((word.front() == 'l' || word.front() == 'r') && isUpper(word[1])) {
        const size_t side = word.front() == 'l' ? kLeft : kRight;
        word.erase(0, 1);
        return side;
    }
    if ((word.back() == 'L' || word.back() == 'R') && isLower(word[word.size() - 2])) {
        const size_t side = word.back() == 'L' ? kLeft : kRight;
        word.pop_back();
        return side;
    }
    return std::nullopt;
}

NameParts partsOf(std::string_view name) {
    NameParts parts;
    if (const size_t colon = name.find_last_of(":|"); colon != std::string_view::npos) {
        name.remove_prefix(colon + 1);
    }
    std::vector<std::string> words(1);
    for (const char c : name) {
        if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
            words.back() += c;
        } else if (!words.back().empty()) {
            words.emplace_back();
        }
    }
    for (std::string& word : words) {
        const std::optional<size_t> side = parts.side ? std::nullopt : sideOfWord(lowered(word));
        if (side) {
            parts.side = side;
            word.clear();
        }
    }
    for (std::string& word : words) {
        if (!parts.side) {
            parts.side = takeSide(word);
        }
        if (!word.empty()) {
            parts.words.push_back(lowered(word));
        }
    }
    return parts;
}

/// "upperleg01" -> "upperleg"; words such as "bip01" before it do not count.
std::string keyOf(const std::vector<std::string>& words) {
    size_t first = 0;
    while (first + 1 < words.size() &&
           std::find(std::begin(kPrefixes), std::end(kPrefixes), withoutDigits(words[first])) != std::end(kPrefixes)) {
        ++first;
    }
    std::string key;
    for (size_t i = first; i < words.size(); ++i) {
        key += words[i];
    }
    constexpr std::string_view kMixamo = "mixamorig"; // some writers leave out the colon behind it
    if (key.size() > kMixamo.size() && key.substr(0, kMixamo.size()) == kMixamo) {
        key.erase(0, kMixamo.size());
    }
    return std::string(withoutDigits(key));
}

/// Nodes that may have a role, the likelier ones first.
using Candidates = std::array<std::vector<uint32_t>, kRoles>;

/// How well a key names a part: 0 is best; nothing: not at all.
std::optional<size_t> rankOf(const std::string& key, const Synonyms& names) {
    if (std::find(names.strong.begin(), names.strong.end(), key) != names.strong.end()) {
        return 0;
    }
    const auto weak = std::find(names.weak.begin(), names.weak.end(), key);
    return weak != names.weak.end() ? std::optional(static_cast<size_t>(weak - names.weak.begin()) + 1) : std::nullopt;
}

Candidates findCandidates(const cage::Skeleton& skeleton) {
    std::array<std::vector<std::pair<size_t, uint32_t>>, kRoles> ranked;
    for (const uint32_t node : skeleton.parentsFirst) {
        const std::string& name = skeleton.nodes[node].name;
        if (name.empty() || name.size() > kLongestName) {
            continue;
        }
        const NameParts parts = partsOf(name);
        const std::string key = keyOf(parts.words);
        for (size_t p = 0; p < kParts; ++p) {
            const std::optional<size_t> rank = rankOf(key, kSynonyms[p]);
            if (rank && (p >= kMiddleParts) == parts.side.has_value()) {
                ranked[roleOf(static_cast<BodyPart>(p), parts.side.value_or(kLeft))].emplace_back(*rank, node);
            }
        }
    }
    Candidates candidates;
    for (size_t role = 0; role < kRoles; ++role) {
        std::stable_sort(ranked[role].begin(), ranked[role].end(),
                         [](const auto& a, const auto& b) { return a.first < b.first; });
        ranked[role].resize(std::min(ranked[role].size(), kMostCandidates));
        std::transform(ranked[role].begin(), ranked[role].end(), std::back_inserter(candidates[role]),
                       [](const auto& candidate) { return candidate.second; });
    }
    return candidates;
}

class RoleFinder {
public:
    RoleFinder(const cage::Skeleton& skeleton, const Roles& given)
        : skeleton_(skeleton), places_(cage::restPlaces(skeleton)), candidates_(findCandidates(skeleton)),
          roles_(given) {
        for (size_t role = 0; role < kRoles; ++role) {
            if (given[role] != kNone) {
                candidates_[role] = {given[role]};
            }
        }
    }

    [[nodiscard]] Roles find() {
        for (const size_t side : {kLeft, kRight}) {
            findLimb({BodyPart::thigh, BodyPart::shin, BodyPart::foot}, side);
            findLimb({BodyPart::upperArm, BodyPart::lowerArm}, side);
            findBelow(BodyPart::toes, side, at(BodyPart::foot, side));
            findBelow(BodyPart::hand, side, at(BodyPart::lowerArm, side));
            findAbove(BodyPart::clavicle, side, at(BodyPart::upperArm, side));
        }
        if (at(BodyPart::hips) == kNone) {
            set(BodyPart::hips, findHips());
        }
        findBelow(BodyPart::neck, kLeft, at(BodyPart::hips));
        findBelow(BodyPart::head, kLeft, at(BodyPart::neck) != kNone ? at(BodyPart::neck) : at(BodyPart::hips));
        return roles_;
    }

private:
    [[nodiscard]] uint32_t at(BodyPart part, size_t side = kLeft) const { return roles_[roleOf(part, side)]; }
    void set(BodyPart part, uint32_t node, size_t side = kLeft) { roles_[roleOf(part, side)] = node; }

    [[nodiscard]] bool isBelow(uint32_t node, uint32_t above) const {
        for (node = skeleton_.nodes[node].parent; node != kNone; node = skeleton_.nodes[node].parent) {
            if (node == above) {
                return true;
            }
        }
        return false;
    }
    /// The likeliest node of a role below another one.
    [[nodiscard]] uint32_t below(BodyPart part, size_t side, uint32_t above) const {
        const std::vector<uint32_t>& nodes = candidates_[roleOf(part, side)];
        const auto found = std::find_if(nodes.begin(), nodes.end(), [&](uint32_t n) { return isBelow(n, above); });
        return found != nodes.end() ? *found : kNone;
    }
    /// Gives the roles of a limb to nodes of which each is below the one before, or to none.
    void findLimb(std::initializer_list<BodyPart> parts, size_t side) {
        for (const uint32_t top : candidates_[roleOf(*parts.begin(), side)]) {
            std::vector<uint32_t> limb{top};
            for (auto part = parts.begin() + 1; part != parts.end() && limb.back() != kNone; ++part) {
                limb.push_back(below(*part, side, limb.back()));
            }
            if (limb.back() != kNone) {
                size_t i = 0;
                for (const BodyPart part : parts) {
                    set(part, limb[i++], side);
                }
                return;
            }
        }
        for (const BodyPart part : parts) {
            set(part, kNone, side);
        }
    }
    void findBelow(BodyPart part, size_t side, uint32_t above) {
        set(part, above == kNone ? kNone : below(part, side, above), side);
    }
    void findAbove(BodyPart part, size_t side, uint32_t node) {
        const std::vector<uint32_t>& nodes = candidates_[roleOf(part, side)];
        const auto found =
            std::find_if(nodes.begin(), nodes.end(), [&](uint32_t n) { return node != kNone && isBelow(node, n); });
        set(part, found != nodes.end() ? *found : kNone, side);
    }
    [[nodiscard]] uint32_t lowestAbove(uint32_t a, uint32_t b) const {
        if (a == kNone || b == kNone) {
            return kNone;
        }
        uint32_t node = skeleton_.nodes[a].parent;
        while (node != kNone && node != b && !isBelow(b, node)) {
            node = skeleton_.nodes[node].parent;
        }
        return node;
    }

    /// The lowest node above both thighs, and above the rest of the body where that is not much lower: some rigs have a
    /// pelvis with the legs beside the spine.
    [[nodiscard]] uint32_t findHips() const {
        const uint32_t pelvis = lowestAbove(at(BodyPart::thigh, kLeft), at(BodyPart::thigh, kRight));
        uint32_t hips = pelvis;
        for (const Role upper : {roleOf(BodyPart::neck), roleOf(BodyPart::head), roleOf(BodyPart::upperArm, kLeft),
                                 roleOf(BodyPart::upperArm, kRight)}) {
            const uint32_t node = roles_[upper] != kNone       ? roles_[upper]
                                  : candidates_[upper].empty() ? kNone
                                                               : candidates_[upper].front();
            if (hips != kNone && node != kNone && !isBelow(node, hips)) {
                hips = lowestAbove(node, hips);
            }
        }
        if (hips == kNone || hips == pelvis) {
            return pelvis;
        }
        const double ankle = heightOf(at(BodyPart::foot, kLeft));
        constexpr double kLeast = 0.6; // of the pelvis' height: roots mostly stand on the ground
        return heightOf(hips) - ankle > kLeast * (heightOf(pelvis) - ankle) ? hips : pelvis;
    }
    [[nodiscard]] double heightOf(uint32_t node) const { return places_[node][3].y; }

    const cage::Skeleton& skeleton_;
    std::vector<glm::dmat4> places_;
    Candidates candidates_;
    Roles roles_;
};

} // namespace

std::string nameOfRole(Role role) {
    if (role < kMiddleParts) {
        return kPartNames[role];
    }
    const size_t part = (role - kMiddleParts) % kSideParts + kMiddleParts;
    return std::string(kPartNames[part]) + (role < kMiddleParts + kSideParts ? ".l" : ".r");
}

std::optional<Role> roleNamed(std::string_view name) {
    for (Role role = 0; role < kRoles; ++role) {
        if (nameOfRole(role) == name) {
            return role;
        }
    }
    return std::nullopt;
}

Roles findRoles(const cage::Skeleton& skeleton, const Roles& given) {
    return RoleFinder(skeleton, given).find();
}

bool hasLegs(const Roles& roles) {
    return whatIsMissing(roles).empty();
}

std::string whatIsMissing(const Roles& roles) {
    std::string missing;
    for (const Role role : {roleOf(BodyPart::foot, kLeft), roleOf(BodyPart::foot, kRight)}) {
        if (roles[role] == kNone) {
            missing += missing.empty() ? "" : " and ";
            missing += role == roleOf(BodyPart::foot, kLeft) ? "left" : "right";
        }
    }
    return !missing.empty()                         ? "no " + missing + " thigh, shin and foot below each other"
           : roles[roleOf(BodyPart::hips)] == kNone ? "nothing above both thighs"
                                                    : "";
}

} // namespace supple::skinning
