// A character is put together from its parts: one cage, one palette, one list of morph targets for all of them.
#pragma once

#include "cage/character.h"
#include "cage/message.h"

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace supple::cage {

/// What a reader has read of one mesh node. Vertices, faces and joints count from 0.
struct PartCage {
    Part part;
    Cage cage;
    SkinWeights weights;             ///< of the joints of part.joints; what is painted is the part's own
    Morphs morphs;                   ///< targets of the part alone
    std::vector<PoseDriver> drivers; ///< of these targets
    std::vector<Jiggle> jiggles;
    std::vector<Cloth> cloths; ///< with colliders of the character
    uint32_t sourceVertexCount = 0;
    uint32_t seamVertexCount = 0;
    std::vector<Damage> damages;
    std::string element;        ///< what messages call it: "mesh 0"
    bool namesBySource = false; ///< messages about its cage call vertices by their numbers in the source
    std::string whyEmpty;       ///< why the cage has no faces
    float gridStep = 0.0f;      ///< of the grid that the positions were rounded to; 0: none
};

/// The palette of a character as skins are added. An entry is a node and an inverse bind matrix; skins share entries
/// that are equal bit for bit, but the joints of one skin stay apart.
class PaletteBuilder {
public:
    explicit PaletteBuilder(Skin& palette) : palette_(&palette) {}
    /// The place of each of the skin's joints in the palette.
    [[nodiscard]] std::vector<uint32_t> add(const Skin& skin);

private:
    using Key = std::pair<uint32_t, std::array<float, 16>>; ///< node, inverse bind matrix
    Skin* palette_;
    std::map<Key, std::vector<uint32_t>> known_; ///< its places
};

/// Turns faces inside out, with all that belongs to their corners. `turned`: by face, 1 for those.
void reverseFaces(Cage& cage, std::span<const uint8_t> turned);

/// For each of `parts` parts, the first part that it is sewn to, directly or by others: they share vertices of the
/// cage. A part that is sewn to none has itself. O(corners).
[[nodiscard]] std::vector<uint32_t> sewnTo(const Cage& cage, size_t parts);

/// One part as a character of its own: its faces, vertices and morph targets; everything else as it was. Vertices keep
/// their order.
[[nodiscard]] Character takePart(const Character& character, size_t part);

/// Finds the parts' first faces anew, after the cage was repaired.
void findFirstFaces(Character& character);

/// By part: the first part with the morph targets that it will have, by joinParts(); itself, if it is that or has none.
/// The character has its clips.
[[nodiscard]] std::vector<size_t> targetOwners(std::span<const PartCage> parts, const Character& character);

/// Puts the parts into the character, in their order: cage, weights, morph targets, counts. The character's clips tell
/// which parts share their morph targets: those of equal names and weights that all clips and drivers move alike, as
/// exporters write them when they cut a mesh. Channels of shared targets are left in once. Returns how messages name
/// the cage's elements: as its parts do.
CageNames joinParts(std::vector<PartCage> parts, Character& character);

} // namespace supple::cage
