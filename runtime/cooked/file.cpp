#include "runtime/cooked/file.h"

#include "cage/character_check.h"
#include "runtime/cooked/table_fields.h"
#include "skinning/packed_clip.h"
#include "surface/schemes.h"
#include "surface/table_check.h"

#include <algorithm>
#include <cmath>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace supple::runtime {

template <>
inline constexpr bool kIsPlain<skinning::MushInfluence> = true;
static_assert(sizeof(skinning::MushInfluence) == 44);

namespace {

constexpr std::array<char, 8> kMagic = {'S', 'U', 'P', 'P', 'L', 'E', '\r', '\n'};
constexpr uint32_t kVersion = 15;
constexpr uint32_t kByteOrder = 0x01020304;

struct Header {
    std::array<char, 8> magic = kMagic;
    uint32_t version = kVersion;
    uint32_t byteOrder = kByteOrder;
    uint64_t byteCount = 0;
    uint64_t hash = 0; ///< XXH3 of what follows
};
static_assert(sizeof(Header) == 32);

uint64_t hashOf(std::span<const std::byte> file) {
    const std::span<const std::byte> hashed = file.subspan(sizeof(Header));
    return XXH3_64bits(hashed.data(), hashed.size());
}

std::string howToMakeIt(const std::string& madeBy) {
    return madeBy.empty() ? "cook it anew" : "make it anew: " + madeBy;
}

/// The header, if the file is whole, of this version, and nobody has changed it.
Status checkHeader(std::span<const std::byte> bytes, Reader& reader, std::string& madeBy) {
    Header header;
    reader(header.magic, header.version, header.byteOrder, header.byteCount, header.hash, madeBy);
    if (header.byteOrder != kByteOrder) {
        return Error{ErrorCode::asset, "cooked on a machine of the other byte order: cook it anew"};
    }
    if (header.version != kVersion) {
        return Error{ErrorCode::asset, "a cooked file of version " + std::to_string(header.version) +
                                           ", and this is version " + std::to_string(kVersion) + ": " +
                                           howToMakeIt(madeBy)};
    }
    if (reader.fault() || header.byteCount != bytes.size()) {
        return Error{ErrorCode::asset, "a cooked file of " + std::to_string(header.byteCount) + " bytes, of which " +
                                           std::to_string(bytes.size()) + " are there"};
    }
    if (header.hash != hashOf(bytes)) {
        return Error{ErrorCode::asset, "the cooked file is damaged: " + howToMakeIt(madeBy)};
    }
    return success();
}

constexpr uint32_t kWholeCage = cage::kNone;

uint32_t placeOf(const Prepared& prepared, const std::shared_ptr<const PreparedPiece>& piece) {
    return piece == nullptr ? kWholeCage
                            : static_cast<uint32_t>(std::find(prepared.pieces.begin(), prepared.pieces.end(), piece) -
                                                    prepared.pieces.begin());
}

/// Room for the header, and all that it is the hash of.
void writeAll(const Prepared& prepared, const std::string& madeBy, Writer& writer) {
    constexpr std::array<std::byte, sizeof(Header)> kRoom{};
    writer.put(std::span<const std::byte>(kRoom));
    writer(madeBy, prepared.character, prepared.choices, prepared.clips.has_value());
    writer(prepared.extras.centers ? std::optional(prepared.extras.centers->points) : std::nullopt);
    writer(prepared.extras.mush.has_value());
    if (prepared.extras.mush) {
        writer(prepared.extras.mush->places, prepared.extras.mush->starts, prepared.extras.mush->influences);
    }
    writer(static_cast<uint32_t>(prepared.pieces.size()));
    for (const auto& piece : prepared.pieces) {
        writer(piece->parts, piece->of);
    }
    writer(static_cast<uint32_t>(prepared.tables.size()));
    for (const auto& own : prepared.tables) {
        writer(own->recipe, placeOf(prepared, own->piece), own->tables);
    }
}

/// Whether what may be anybody's is the coarse twin of a clip that is packed, or there is none.
Status checkTwin(const cage::Clip& clip, const skinning::PackedPlaces& places) {
    const std::vector<uint32_t>& words = clip.packed.coarseWords;
    if (words.empty()) {
        return success();
    }
    const Result<skinning::PackedClip> twin = skinning::readPackedWords(words, clip.duration, places);
    if (!twin) {
        return twin.error();
    }
    if (!skinning::areTwins(clip.packed.words, words)) {
        return Error{ErrorCode::asset, "it has other frames than the clip"};
    }
    return skinning::segmentWords(clip.packed.words) > 0
               ? success()
               : Status(Error{ErrorCode::asset, "the clip has no segments that it could stand in for"});
}

/// Gives packed clips of a character that is sound their channels. Whether there are any.
Result<bool> unpackClips(cage::Character& character) {
    std::optional<skinning::NodeOrder> order;
    for (cage::Clip& clip : character.clips) {
        if (clip.packed.words.empty()) {
            clip.packed.coarseWords.clear(); // a twin of nothing
            continue;
        }
        order = order ? std::move(order) : skinning::nodeOrder(character);
        const skinning::PackedPlaces places{order->nodes.size(), order->targetCount};
        const Result<skinning::PackedClip> packed = skinning::readPackedWords(clip.packed.words, clip.duration, places);
        if (!packed) {
            return Error{packed.error().code, "clip " + clip.name + ": " + packed.error().message};
        }
        if (const Status sound = checkTwin(clip, places); !sound) {
            return Error{sound.error().code, "clip " + clip.name + ": its coarse twin: " + sound.error().message};
        }
        std::vector<cage::Channel> channels =
            skinning::channelsOf(*packed, clip.duration, order->nodes, order->targetCount);
        clip.packed.channelCount = static_cast<uint32_t>(channels.size());
        clip.channels.insert(clip.channels.begin(), std::make_move_iterator(channels.begin()),
                             std::make_move_iterator(channels.end()));
    }
    return order.has_value();
}

/// What all that follows is read for: the header and the character.
Status readBeginning(std::span<const std::byte> bytes, const std::string& name, Reader& reader, Prepared& prepared,
                     bool& plays) {
    const auto refused = [&](const std::string& reason) { return Error{ErrorCode::asset, name + ": " + reason}; };
    if (const Status whole = checkHeader(bytes, reader, prepared.madeBy); !whole) {
        return refused(whole.error().message);
    }
    reader(prepared.character, prepared.choices, plays);
    if (reader.fault()) {
        return refused(*reader.fault());
    }
    cage::Character& character = prepared.character;
    character.name = name;
    if (const Status sound = cage::checkCharacter(character); !sound) {
        return sound.error();
    }
    const Result<bool> unpacked = unpackClips(character);
    if (!unpacked) {
        return refused(unpacked.error().message);
    }
    if (const Status sound = *unpacked ? cage::checkCharacter(character) : success(); !sound) {
        return sound.error();
    }
    if (prepared.choices.size() != character.parts.size()) {
        return refused("no scheme is chosen for some part");
    }
    return success();
}

/// For each vertex (point, 1), or zeros if it has none.
bool arePlaces(const std::vector<glm::vec4>& points, size_t vertexCount) {
    return points.size() == vertexCount && std::all_of(points.begin(), points.end(), [](const glm::vec4& point) {
               return std::isfinite(point.x + point.y + point.z) && (point.w == 0.0f || point.w == 1.0f);
           });
}

void readCenters(Reader& reader, Prepared& prepared) {
    std::optional<std::vector<glm::vec4>> points;
    reader(points);
    if (reader.fault() || !points) {
        return;
    }
    if (!arePlaces(*points, prepared.character.cage.positions.size())) {
        reader.refuse("centers of rotation that are none");
        return;
    }
    prepared.extras.centers = skinning::Centers::of(prepared.character, std::move(*points));
}

bool isSoundInfluence(const skinning::MushInfluence& influence, size_t jointCount) {
    const glm::vec3& o = influence.offset;
    return influence.joint < jointCount && influence.weight >= 0.0f && std::isfinite(influence.weight) &&
           std::isfinite(o.x + o.y + o.z) &&
           std::all_of(influence.spread.begin(), influence.spread.end(), [](float x) { return std::isfinite(x); });
}

void readMush(Reader& reader, Prepared& prepared) {
    bool isThere = false;
    reader(isThere);
    if (reader.fault() || !isThere) {
        return;
    }
    std::vector<glm::vec4> places;
    std::vector<uint32_t> starts;
    std::vector<skinning::MushInfluence> influences;
    reader(places, starts, influences);
    if (reader.fault()) {
        return;
    }
    const size_t joints = prepared.character.skin.joints.size(), vertices = prepared.character.cage.positions.size();
    const bool sound = arePlaces(places, vertices) && starts.size() == vertices + 1 && starts.front() == 0 &&
                       starts.back() == influences.size() &&
                       std::adjacent_find(starts.begin(), starts.end(), std::greater_equal<>()) == starts.end() &&
                       std::all_of(influences.begin(), influences.end(), [&](const skinning::MushInfluence& influence) {
                           return isSoundInfluence(influence, joints);
                       });
    if (!sound) {
        reader.refuse("smoothed weights that are none");
        return;
    }
    prepared.extras.mush =
        skinning::DeltaMush::of(prepared.character, std::move(places), std::move(starts), std::move(influences));
}

void readPieces(Reader& reader, Prepared& prepared) {
    uint32_t count = 0;
    reader(count);
    for (uint32_t i = 0; i < count && !reader.fault(); ++i) {
        auto piece = std::make_shared<PreparedPiece>();
        reader(piece->parts, piece->of);
        const bool parts =
            !piece->parts.empty() && piece->parts.back() < prepared.character.parts.size() &&
            std::adjacent_find(piece->parts.begin(), piece->parts.end(), std::greater_equal<>()) == piece->parts.end();
        if (!parts) {
            reader.refuse("a piece of no parts");
        } else if (const Status sound = cage::checkPiece(prepared.character, piece->of); !reader.fault() && !sound) {
            reader.refuse(sound.error().message);
        }
        prepared.pieces.push_back(std::move(piece));
    }
}

void readTables(Reader& reader, Prepared& prepared) {
    uint32_t count = 0;
    reader(count);
    for (uint32_t i = 0; i < count && !reader.fault(); ++i) {
        auto own = std::make_shared<PreparedTables>();
        uint32_t place = kWholeCage;
        reader(own->recipe, place, own->tables);
        if (reader.fault()) {
            return;
        }
        if (place != kWholeCage && place >= prepared.pieces.size()) {
            reader.refuse("tables of no piece");
            return;
        }
        own->piece = place != kWholeCage ? prepared.pieces[place] : nullptr;
        const cage::Character& character = prepared.character;
        const surface::TableSource source{own->recipe,
                                          prepared.cageOf(own->piece.get()).vertexCount(),
                                          character.cage.faceCount(),
                                          static_cast<uint32_t>(character.parts.size()),
                                          static_cast<uint32_t>(character.materials.size()),
                                          character.cage.vertexCount()};
        if (const Status sound = surface::checkTables(own->tables, source); !sound) {
            reader.refuse(sound.error().message);
        }
        prepared.tables.push_back(std::move(own));
    }
}

} // namespace

bool isCooked(std::span<const std::byte> bytes) {
    return bytes.size() >= sizeof(Header) && std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) == 0;
}

size_t cookedBytes(const Prepared& prepared, const std::string& madeBy) {
    Writer counter({});
    writeAll(prepared, madeBy, counter);
    return counter.byteCount();
}

void writeCooked(const Prepared& prepared, const std::string& madeBy, std::span<std::byte> out) {
    Writer writer(out);
    writeAll(prepared, madeBy, writer);
    Header header;
    header.byteCount = out.size();
    header.hash = hashOf(out);
    std::memcpy(out.data(), &header, sizeof(header));
}

std::vector<std::byte> writeCooked(const Prepared& prepared, const std::string& madeBy) {
    std::vector<std::byte> bytes(cookedBytes(prepared, madeBy));
    writeCooked(prepared, madeBy, bytes);
    return bytes;
}

std::vector<std::byte> writeCookedCharacter(const Prepared& prepared) {
    Prepared alone;
    alone.character = prepared.character;
    alone.character.name.clear();
    alone.choices = prepared.choices;
    return writeCooked(alone, "");
}

Result<cage::Character> readCookedCharacter(std::span<const std::byte> bytes, const std::string& name) {
    Reader reader(bytes);
    Prepared prepared;
    bool plays = false;
    if (const Status read = readBeginning(bytes, name, reader, prepared, plays); !read) {
        return read.error();
    }
    return std::move(prepared.character);
}

Result<std::shared_ptr<Prepared>> readCooked(std::span<const std::byte> bytes, const std::string& name) {
    Reader reader(bytes);
    auto prepared = std::make_shared<Prepared>();
    bool plays = false;
    if (const Status read = readBeginning(bytes, name, reader, *prepared, plays); !read) {
        return read.error();
    }
    prepared->follow();
    if (plays) {
        prepared->clips = skinning::buildClipTable(prepared->character);
    }
    readCenters(reader, *prepared);
    readMush(reader, *prepared);
    readPieces(reader, *prepared);
    readTables(reader, *prepared);
    if (!reader.fault() && reader.bytesLeft() > 0) {
        reader.refuse("more than a character");
    }
    if (reader.fault()) {
        return Error{ErrorCode::asset, name + ": " + *reader.fault()};
    }
    return prepared;
}

Status checkMapping(const Prepared& prepared, bool wide) {
    bool has = false, hasOther = false;
    for (const auto& own : prepared.tables) {
        if (surface::schemeOf(own->recipe.scheme).ofMapping) {
            (own->recipe.wide == wide ? has : hasOther) = true;
        }
    }
    if (has || !hasOther) {
        return success();
    }
    return Error{ErrorCode::asset, prepared.character.name + ": cooked for the " + (wide ? "narrow" : "wide") +
                                       " mapping alone, and this device has the " + (wide ? "wide" : "narrow") +
                                       " one: " + howToMakeIt(prepared.madeBy) + ", with --mapping " +
                                       (wide ? "wide" : "narrow") + " or both"};
}

} // namespace supple::runtime
