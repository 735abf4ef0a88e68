#include "skinning/roles.h"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <utility>
#include <vector>

namespace supple::skinning {
namespace {

using cage::kNone;

constexpr const char* kPartNames[kParts] = {"hips", "neck",     "head",     "thigh",    "shin", "foot",
                                            "toes", "clavicle", "upperarm", "lowerarm", "hand"};

/// What a part is called, in small letters and without digits. Names of `weak` mean it only where no other node has one
/// of the first: a leg is a thigh above a knee, and a shin below an upper leg.
struct Synonyms {
    std::initializer_list<std::string_view> strong, weak;
};
const Synonyms kSynonyms[kParts] = {
    {{"hips", "pelvis"}, {"hip"}},
    {{"neck"}, {}},
    {{"head"}, {}},
    {{"thigh", "upperleg", "upleg", "legupper"}, {"leg", "hip", "femur"}},
    {{"shin", "calf", "lowerleg", "lowleg", "leglower"}, {"leg", "knee"}},
    {{"foot"}, {"ankle"}},
    {{"toes", "toe", "ball", "toebase"}, {}},
    {{"clavicle", "shoulder", "collar"}, {}},
    {{"upperarm", "uparm", "armupper"}, {"arm", "shoulder"}},
    {{"lowerarm", "lowarm", "forearm", "armlower"}, {"elbow", "arm"}},
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
    return std::string(withoutDigits(key));
}

/// Nodes that may have a role, the likelier ones first.
using Candidates = std::array<std::vector<uint32_t>, kRoles>;

Candidates findCandidates(const cage::Skeleton& skeleton) {
    Candidates strong, weak;
    for (const uint32_t node : skeleton.parentsFirst) {
        const std::string& name = skeleton.nodes[node].name;
        if (name.empty() || name.size() > kLongestName) {
            continue;
        }
        const NameParts parts = partsOf(name);
        const std::string key = keyOf(parts.words);
        for (size_t p = 0; p < kParts; ++p) {
            const bool isSided = p >= kMiddleParts;
            if (isSided != parts.side.has_value()) {
                continue;
            }
            const auto isOf = [&](const auto& names) {
                return std::find(names.begin(), names.end(), key) != names.end();
            };
            const Role role = roleOf(static_cast<Part>(p), parts.side.value_or(kLeft));
            if (isOf(kSynonyms[p].strong)) {
                strong[role].push_back(node);
            } else if (isOf(kSynonyms[p].weak)) {
                weak[role].push_back(node);
            }
        }
    }
    for (size_t role = 0; role < kRoles; ++role) {
        strong[role].insert(strong[role].end(), weak[role].begin(), weak[role].end());
        strong[role].resize(std::min(strong[role].size(), kMostCandidates));
    }
    return strong;
}

class RoleFinder {
public:
    RoleFinder(const cage::Skeleton& skeleton, const Roles& given)
        : skeleton_(skeleton), candidates_(findCandidates(skeleton)), roles_(given) {
        for (size_t role = 0; role < kRoles; ++role) {
            if (given[role] != kNone) {
                candidates_[role] = {given[role]};
            }
        }
    }

    [[nodiscard]] Roles find() {
        for (const size_t side : {kLeft, kRight}) {
            findLimb({Part::thigh, Part::shin, Part::foot}, side);
            findLimb({Part::upperArm, Part::lowerArm}, side);
            findBelow(Part::toes, side, at(Part::foot, side));
            findBelow(Part::hand, side, at(Part::lowerArm, side));
            findAbove(Part::clavicle, side, at(Part::upperArm, side));
        }
        if (at(Part::hips) == kNone) {
            set(Part::hips, lowestAbove(at(Part::thigh, kLeft), at(Part::thigh, kRight)));
        }
        findBelow(Part::neck, kLeft, at(Part::hips));
        findBelow(Part::head, kLeft, at(Part::neck) != kNone ? at(Part::neck) : at(Part::hips));
        return roles_;
    }

private:
    [[nodiscard]] uint32_t at(Part part, size_t side = kLeft) const { return roles_[roleOf(part, side)]; }
    void set(Part part, uint32_t node, size_t side = kLeft) { roles_[roleOf(part, side)] = node; }

    [[nodiscard]] bool isBelow(uint32_t node, uint32_t above) const {
        for (node = skeleton_.nodes[node].parent; node != kNone; node = skeleton_.nodes[node].parent) {
            if (node == above) {
                return true;
            }
        }
        return false;
    }
    /// The likeliest node of a role below another one.
    [[nodiscard]] uint32_t below(Part part, size_t side, uint32_t above) const {
        const std::vector<uint32_t>& nodes = candidates_[roleOf(part, side)];
        const auto found = std::find_if(nodes.begin(), nodes.end(), [&](uint32_t n) { return isBelow(n, above); });
        return found != nodes.end() ? *found : kNone;
    }
    /// Gives the roles of a limb to nodes of which each is below the one before, or to none.
    void findLimb(std::initializer_list<Part> parts, size_t side) {
        for (const uint32_t top : candidates_[roleOf(*parts.begin(), side)]) {
            std::vector<uint32_t> limb{top};
            for (auto part = parts.begin() + 1; part != parts.end() && limb.back() != kNone; ++part) {
                limb.push_back(below(*part, side, limb.back()));
            }
            if (limb.back() != kNone) {
                size_t i = 0;
                for (const Part part : parts) {
                    set(part, limb[i++], side);
                }
                return;
            }
        }
        for (const Part part : parts) {
            set(part, kNone, side);
        }
    }
    void findBelow(Part part, size_t side, uint32_t above) {
        set(part, above == kNone ? kNone : below(part, side, above), side);
    }
    void findAbove(Part part, size_t side, uint32_t node) {
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
        while (node != kNone && !isBelow(b, node)) {
            node = skeleton_.nodes[node].parent;
        }
        return node;
    }

    const cage::Skeleton& skeleton_;
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
    const auto has = [&](Part part, size_t side) { return roles[roleOf(part, side)] != kNone; };
    return has(Part::hips, kLeft) && has(Part::foot, kLeft) && has(Part::foot, kRight);
}

} // namespace supple::skinning
