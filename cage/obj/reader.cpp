#include "cage/obj/reader.h"

#include "cage/corner_normals.h"
#include "cage/finish.h"
#include "cage/leniency.h"
#include "cage/limits.h"
#include "cage/materials.h"
#include "cage/message.h"
#include "cage/refusal.h"
#include "cage/single_joint.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <map>
#include <new>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace supple::cage {
namespace {

/// Kinds of ignored statements that are told apart.
constexpr size_t kMaxIgnoredKinds = 8;
constexpr size_t kMaxQuotedText = 40;

std::string lineName(size_t line) {
    return at("line", line);
}

std::string shortened(std::string_view text) {
    return quoted(text.size() > kMaxQuotedText ? std::string(text.substr(0, kMaxQuotedText)) + "..."
                                               : std::string(text));
}

/// Logical lines: those that end in a backslash go on. Numbers count the file's own lines.
class Lines {
public:
    explicit Lines(std::string_view text) : rest_(text) {}

    bool next() {
        if (rest_.empty()) {
            return false;
        }
        number_ = physical_ + 1;
        line_ = takeLine();
        if (!continues(line_)) {
            return true;
        }
        joined_.clear();
        while (continues(line_)) {
            joined_.append(line_.substr(0, line_.size() - 1)).append(" ");
            line_ = takeLine();
        }
        joined_.append(line_);
        line_ = joined_;
        return true;
    }
    [[nodiscard]] size_t number() const { return number_; }
    [[nodiscard]] std::string_view line() const { return line_; }

private:
    static bool continues(std::string_view line) { return !line.empty() && line.back() == '\\'; }

    /// Lines end in LF, CR LF or, on old machines, CR.
    std::string_view takeLine() {
        ++physical_;
        const size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
        const std::string_view line = rest_.substr(0, end);
        const bool isPair = rest_.substr(end).starts_with("\r\n");
        rest_.remove_prefix(std::min(end + (isPair ? 2 : 1), rest_.size()));
        return line;
    }

    std::string_view rest_;
    std::string_view line_;
    std::string joined_;
    size_t physical_ = 0;
    size_t number_ = 0;
};

/// The words of a line up to its comment.
class Words {
public:
    explicit Words(std::string_view line) : rest_(line.substr(0, line.find('#'))) {}

    /// Empty at the end.
    std::string_view next() {
        const size_t begin = std::min(rest_.find_first_not_of(kSpace), rest_.size());
        rest_.remove_prefix(begin);
        const size_t end = std::min(rest_.find_first_of(kSpace), rest_.size());
        const std::string_view word = rest_.substr(0, end);
        rest_.remove_prefix(end);
        return word;
    }
    /// All that is left, without space around it.
    std::string_view tail() {
        const size_t begin = rest_.find_first_not_of(kSpace);
        const size_t end = rest_.find_last_not_of(kSpace);
        return begin == std::string_view::npos ? std::string_view() : rest_.substr(begin, end + 1 - begin);
    }

private:
    static constexpr std::string_view kSpace = " \t\r\v\f";
    std::string_view rest_;
};

bool parseWhole(std::string_view word, auto& value) {
    if (!word.empty() && word.front() == '+') {
        word.remove_prefix(1);
    }
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc() && end == word.data() + word.size() && !word.empty();
}

float toFloat(std::string_view word, const std::string& element) {
    double value = 0.0;
    if (word.empty()) {
        refuse(element, "a number is missing");
    }
    if (!parseWhole(word, value) || !std::isfinite(static_cast<float>(value))) {
        refuse(element, shortened(word) + " is not a finite number");
    }
    return static_cast<float>(value);
}

int64_t toInteger(std::string_view word, const std::string& element) {
    int64_t value = 0;
    if (!parseWhole(word, value)) {
        refuse(element, (word.empty() ? "an index is missing" : shortened(word) + " is not an index"));
    }
    return value;
}

/// A chain of sharp edges as a tag gives it, in the file's vertices.
struct TaggedCrease {
    int64_t a = 0;
    int64_t b = 0;
    float sharpness = 0.0f;
    size_t line = 0;
};

struct TaggedCorner {
    int64_t vertex = 0;
    float sharpness = 0.0f;
    size_t line = 0;
};

struct TaggedHole {
    int64_t face = 0;
    size_t line = 0;
};

struct Corner {
    uint32_t vertex = 0;
    uint32_t uv = kNone;
    uint32_t normal = kNone;
};

class ObjParser {
public:
    ObjParser(PartCage& part, bool strict, Character& out) : part_(part), out_(out), leniency_(strict) {}

    void parse(std::string_view text) {
        if (text.starts_with("\xEF\xBB\xBF")) {
            text.remove_prefix(3);
        }
        for (Lines lines(text); lines.next();) {
            line_ = lines.number();
            parseLine(lines.line());
        }
        leniency_.raise();
        if (faceLines_.empty()) {
            leniency_.refuseAll({"file: " + nameOfNoFaces()});
        }
        checkCorners();
        checkTags();
        leniency_.raise();
        buildFaces();
        buildTags();
        if (part_.cage.faceCount() == 0) {
            leniency_.refuseAll({});
        }
        compactVertices();
        reportIgnored();
        for (Damage& damage : leniency_.takeDamages()) {
            out_.damages.push_back(std::move(damage));
        }
    }

private:
    void parseLine(std::string_view line) {
        Words words(line);
        const std::string_view keyword = words.next();
        if (keyword == "v") {
            leniency_.gather([&] { parsePosition(words); }); // all that follows counts on it
        } else if (keyword == "vt") {
            parseUv(words);
        } else if (keyword == "vn") {
            parseNormal(words);
        } else if (keyword == "f") {
            parseFace(words);
        } else if (keyword == "p") {
            points_ = true;
            ignore("p");
        } else if (keyword == "l") {
            lines_ = true;
            ignore("l");
        } else if (keyword == "usemtl") {
            parseMaterial(words);
        } else if (keyword == "t") {
            leniency_.leaveOut([&] { parseTag(words); });
        } else if (!keyword.empty() && keyword != "vp" && keyword != "g" && keyword != "o" && keyword != "s") {
            ignore(std::string(keyword.substr(0, kMaxQuotedText)));
        }
    }

    void parsePosition(Words& words) {
        const std::string element = lineName(line_);
        if (positions_.size() == kMaxVertices) {
            refuse(element, "more than " + std::to_string(kMaxVertices) + " vertices", ErrorCode::limit);
        }
        glm::vec3 position;
        for (int k = 0; k < 3; ++k) {
            position[k] = toFloat(words.next(), element + ": position");
            if (const char* fault = faultOfCoordinate(position[k])) {
                refuse(element + ": position", fault);
            }
        }
        positions_.push_back(position);
        // A fourth number is a rational weight; six or more end in a color.
        words.next();
        if (!words.next().empty()) {
            ignore("colors of v");
        }
    }

    void parseUv(Words& words) {
        const std::string element = lineName(line_);
        if (uvs_.size() == kMaxCorners) {
            refuse(element, "more than " + std::to_string(kMaxCorners) + " texture coordinates", ErrorCode::limit);
        }
        glm::vec2 uv(0.0f, 1.0f);
        leniency_.leaveOut([&] {
            const float u = toFloat(words.next(), element + ": texture coordinate");
            const std::string_view second = words.next();
            const float v = second.empty() ? 0.0f : toFloat(second, element + ": texture coordinate");
            uv = {u, 1.0f - v};
        });
        uvs_.push_back(uv); // also a faulty one: the others keep their numbers
    }

    void addFaultyNormal(size_t line) {
        faultyNormals_.line = faultyNormals_.count++ == 0 ? line : faultyNormals_.line;
    }

    /// A cage needs no normals: one that is malformed becomes zero, which means none.
    void parseNormal(Words& words) {
        if (normals_.size() == kMaxCorners) {
            refuse(lineName(line_), "more than " + std::to_string(kMaxCorners) + " normals", ErrorCode::limit);
        }
        glm::dvec3 normal(0.0);
        bool sound = true;
        for (int k = 0; k < 3; ++k) {
            sound = parseWhole(words.next(), normal[k]) && sound;
        }
        normals_.push_back(sound ? unitNormal(normal) : glm::vec3(0.0f));
        if (normals_.back() == glm::vec3(0.0f)) {
            addFaultyNormal(line_);
        }
    }

    /// `count` elements stand before this line; later ones may be named too.
    uint32_t resolve(std::string_view word, size_t count, const char* what, const std::string& element) const {
        const int64_t index = toInteger(word, element);
        const int64_t fromZero = index > 0 ? index - 1 : static_cast<int64_t>(count) + index;
        if (index == 0 || fromZero < 0 || fromZero >= static_cast<int64_t>(kMaxCorners)) {
            refuse(element, std::string(what) + " " + std::to_string(index) + " of " + std::to_string(count));
        }
        return static_cast<uint32_t>(fromZero);
    }

    /// A face that is left out has no corners, so that the others keep their numbers.
    void parseFace(Words& words) {
        const size_t first = corners_.size();
        const bool isWhole = leniency_.leaveOut([&] { parseCorners(words, first); });
        if (!isWhole) {
            corners_.resize(first);
        }
        faceIsWhole_.push_back(isWhole ? 1 : 0);
        faceStarts_.push_back(static_cast<uint32_t>(corners_.size()));
        faceMaterials_.push_back(material_);
        faceLines_.push_back(line_);
    }

    void parseCorners(Words& words, size_t first) {
        for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
            const std::string element = cornerName(line_, corners_.size() - first);
            if (corners_.size() == kMaxCorners) {
                refuse(element, "more than " + std::to_string(kMaxCorners) + " corners", ErrorCode::limit);
            }
            const size_t slash = std::min(word.find('/'), word.size());
            Corner corner;
            corner.vertex = resolve(word.substr(0, slash), positions_.size(), "vertex", element);
            const std::string_view behind = word.substr(std::min(slash + 1, word.size()));
            const std::string_view uv = behind.substr(0, behind.find('/'));
            if (!uv.empty()) {
                corner.uv = resolve(uv, uvs_.size(), "texture coordinate", element);
            }
            const std::string_view normal = behind.substr(std::min(uv.size() + 1, behind.size()));
            if (!normal.empty()) {
                corner.normal = resolve(normal, normals_.size(), "normal", element);
            }
            corners_.push_back(corner);
        }
    }

    void parseMaterial(Words& words) {
        const std::string name(words.tail());
        const auto [known, isNew] = materials_.try_emplace(name, static_cast<uint32_t>(out_.materials.size()));
        if (isNew) {
            out_.materials.push_back(namedMaterial(name));
        }
        material_ = known->second;
    }

    void parseTag(Words& words) {
        const std::string_view name = words.next();
        const std::string element = lineName(line_) + ": t " + std::string(name.substr(0, kMaxQuotedText));
        if (name != "crease" && name != "corner" && name != "hole" && name != "interpolateboundary") {
            ignore("t " + std::string(name.substr(0, kMaxQuotedText)));
            return;
        }
        size_t counts[3] = {0, 0, 0}; // integers, floats, strings
        std::string_view rest = words.next();
        for (size_t& count : counts) {
            const size_t slash = std::min(rest.find('/'), rest.size());
            if (!parseWhole(rest.substr(0, slash), count)) {
                refuse(element, "no counts of the form integers/floats/strings");
            }
            rest.remove_prefix(std::min(slash + 1, rest.size()));
        }
        std::vector<int64_t> integers;
        for (size_t i = 0; i < counts[0]; ++i) {
            integers.push_back(toInteger(words.next(), element));
        }
        std::vector<float> floats;
        for (size_t i = 0; i < counts[1]; ++i) {
            floats.push_back(toFloat(words.next(), element));
        }
        if (name == "crease") {
            addCreases(integers, floats, element);
        } else if (name == "corner") {
            addSharpVertices(integers, floats, element);
        } else if (name == "hole") {
            for (const int64_t face : integers) {
                holes_.push_back({face, line_});
            }
        } else if (integers.size() != 1 || integers[0] != kEdgeAndCorner) {
            ignore("t interpolateboundary other than 1 (edges and corners)");
        }
    }

    void addCreases(const std::vector<int64_t>& vertices, const std::vector<float>& floats,
                    const std::string& element) {
        if (vertices.size() < 2 || (floats.size() != 1 && floats.size() != vertices.size() - 1)) {
            refuse(element, counted(floats.size(), "sharpness", "sharpnesses") + " for " +
                                counted(vertices.size(), "vertex", "vertices"));
        }
        for (size_t i = 0; i + 1 < vertices.size(); ++i) {
            creases_.push_back({vertices[i], vertices[i + 1], floats[floats.size() == 1 ? 0 : i], line_});
        }
    }

    void addSharpVertices(const std::vector<int64_t>& vertices, const std::vector<float>& floats,
                          const std::string& element) {
        if (vertices.empty() || (floats.size() != 1 && floats.size() != vertices.size())) {
            refuse(element, counted(floats.size(), "sharpness", "sharpnesses") + " for " +
                                counted(vertices.size(), "vertex", "vertices"));
        }
        for (size_t i = 0; i < vertices.size(); ++i) {
            sharpVertices_.push_back({vertices[i], floats[floats.size() == 1 ? 0 : i], line_});
        }
    }

    /// Tells of the first corner that is out of range, of each kind, and how many more there are. A face without a
    /// vertex is left out, a texture coordinate or a normal alone.
    void checkCorners() {
        Found vertices;
        Found uvs;
        for (size_t f = 0; f < faceLines_.size(); ++f) {
            const auto isMissing = [&](uint32_t corner, const char* what, uint32_t index, size_t count, Found& found) {
                if (index == kNone || index < count) {
                    return false;
                }
                found.add([&] {
                    return cornerName(faceLines_[f], corner - faceStarts_[f]) + ": " + what + " " +
                           std::to_string(index + 1) + " of " + std::to_string(count);
                });
                return true;
            };
            for (uint32_t c = faceStarts_[f]; c < faceStarts_[f + 1]; ++c) {
                if (isMissing(c, "vertex", corners_[c].vertex, positions_.size(), vertices)) {
                    faceIsWhole_[f] = 0;
                }
                if (isMissing(c, "texture coordinate", corners_[c].uv, uvs_.size(), uvs)) {
                    corners_[c].uv = kNone;
                }
                if (corners_[c].normal != kNone && corners_[c].normal >= normals_.size()) {
                    addFaultyNormal(faceLines_[f]);
                    corners_[c].normal = kNone;
                }
            }
        }
        leaveOutFound(vertices);
        leaveOutFound(uvs);
    }

    void leaveOutFound(const Found& found) {
        if (found.count > 0) {
            leniency_.leaveOut(
                {ErrorCode::asset,
                 {found.first +
                  (found.count > 1 ? ", and " + std::to_string(found.count - 1) + " more like it" : "")}});
        }
    }

    /// Leaves out the tags of vertices and faces that are not there.
    void checkTags() {
        const auto isMissing = [&](int64_t index, size_t count, const char* tag, const char* what, size_t line) {
            if (index >= 0 && index < static_cast<int64_t>(count)) {
                return false;
            }
            leniency_.leaveOut({ErrorCode::asset,
                                {lineName(line) + ": t " + tag + ": " + what + " " + std::to_string(index) + " of " +
                                 std::to_string(count)}});
            return true;
        };
        std::erase_if(creases_, [&](const TaggedCrease& tag) {
            const bool a = isMissing(tag.a, positions_.size(), "crease", "vertex", tag.line);
            const bool b = isMissing(tag.b, positions_.size(), "crease", "vertex", tag.line);
            return a || b;
        });
        std::erase_if(sharpVertices_, [&](const TaggedCorner& tag) {
            return isMissing(tag.vertex, positions_.size(), "corner", "vertex", tag.line);
        });
        std::erase_if(holes_, [&](const TaggedHole& tag) {
            return isMissing(tag.face, faceLines_.size(), "hole", "face", tag.line);
        });
    }

    void buildFaces() {
        Cage& cage = part_.cage;
        const bool uvs = std::any_of(corners_.begin(), corners_.end(), [](const Corner& c) { return c.uv != kNone; });
        const bool normals =
            std::any_of(corners_.begin(), corners_.end(), [](const Corner& c) { return c.normal != kNone; });
        cage.faceStarts = {0};
        for (size_t f = 0; f < faceLines_.size(); ++f) {
            places_.push_back(faceIsWhole_[f] != 0 ? cage.faceCount() : kNone);
            if (faceIsWhole_[f] == 0) {
                continue;
            }
            for (uint32_t c = faceStarts_[f]; c < faceStarts_[f + 1]; ++c) {
                const Corner& corner = corners_[c];
                cage.faceVertices.push_back(corner.vertex);
                if (uvs) {
                    cage.cornerUvs.push_back(corner.uv == kNone ? glm::vec2(0.0f) : uvs_[corner.uv]);
                }
                if (normals) {
                    cage.cornerNormals.push_back(corner.normal == kNone ? glm::vec3(0.0f) : normals_[corner.normal]);
                }
            }
            cage.faceStarts.push_back(cage.cornerCount());
            cage.faceMaterials.push_back(faceMaterials_[f]);
        }
    }

    /// Creases, sharp vertices and holes; of several on one element the sharpest counts.
    void buildTags() {
        Cage& cage = part_.cage;
        std::vector<std::pair<uint32_t, uint32_t>> edges;
        for (uint32_t f = 0; f < cage.faceCount() && !creases_.empty(); ++f) {
            for (uint32_t c = cage.faceStarts[f]; c < cage.faceStarts[f + 1]; ++c) {
                const uint32_t next = c + 1 < cage.faceStarts[f + 1] ? c + 1 : cage.faceStarts[f];
                edges.emplace_back(std::minmax(cage.faceVertices[c], cage.faceVertices[next]));
            }
        }
        std::sort(edges.begin(), edges.end());
        std::map<std::pair<uint32_t, uint32_t>, float> creases;
        size_t strays = 0;
        size_t firstStray = 0;
        for (const TaggedCrease& tag : creases_) {
            const auto a = static_cast<uint32_t>(tag.a);
            const auto b = static_cast<uint32_t>(tag.b);
            const std::pair<uint32_t, uint32_t> edge = std::minmax(a, b);
            if (!std::binary_search(edges.begin(), edges.end(), edge)) {
                firstStray = strays++ == 0 ? tag.line : firstStray;
                continue;
            }
            float& sharpness = creases[edge];
            sharpness = std::max(sharpness, tag.sharpness);
        }
        for (const auto& [edge, sharpness] : creases) {
            if (sharpness > 0.0f) {
                cage.creases.push_back({edge.first, edge.second, sharpness});
            }
        }
        if (strays > 0) {
            warn(out_.warnings, lineName(firstStray),
                 counted(strays, "crease is not an edge", "creases are not edges, this being the first") +
                     "; left out");
        }

        std::map<uint32_t, float> sharpVertices;
        for (const TaggedCorner& tag : sharpVertices_) {
            float& sharpness = sharpVertices[static_cast<uint32_t>(tag.vertex)];
            sharpness = std::max(sharpness, tag.sharpness);
        }
        for (const auto& [vertex, sharpness] : sharpVertices) {
            if (sharpness > 0.0f) {
                cage.sharpVertices.push_back({vertex, sharpness});
            }
        }

        for (const TaggedHole& tag : holes_) {
            if (const uint32_t place = places_[static_cast<size_t>(tag.face)]; place != kNone) {
                cage.holes.push_back(place);
            }
        }
        std::sort(cage.holes.begin(), cage.holes.end());
        cage.holes.erase(std::unique(cage.holes.begin(), cage.holes.end()), cage.holes.end());
    }

    void compactVertices() {
        Cage& cage = part_.cage;
        std::vector<uint32_t> cageVertices(positions_.size(), kNone);
        for (const uint32_t v : cage.faceVertices) {
            cageVertices[v] = 0;
        }
        for (uint32_t v = 0; v < positions_.size(); ++v) {
            if (cageVertices[v] != kNone) {
                cageVertices[v] = cage.vertexCount();
                cage.positions.push_back(positions_[v]);
                cage.sourceVertices.push_back(v);
            }
        }
        part_.sourceVertexCount = static_cast<uint32_t>(positions_.size());
        const size_t unused = positions_.size() - cage.positions.size();
        if (unused == 0) {
            return;
        }
        warn(out_.warnings, "file", counted(unused, "vertex has", "vertices have") + " no face; left out");
        for (uint32_t& v : cage.faceVertices) {
            v = cageVertices[v];
        }
        for (Crease& crease : cage.creases) {
            crease.a = cageVertices[crease.a];
            crease.b = cageVertices[crease.b];
        }
        for (SharpVertex& sharp : cage.sharpVertices) {
            sharp.vertex = cageVertices[sharp.vertex];
        }
        std::erase_if(cage.sharpVertices, [](const SharpVertex& sharp) { return sharp.vertex == kNone; });
    }

    void ignore(const std::string& kind) {
        const auto known = ignored_.find(kind);
        if (known != ignored_.end()) {
            ++known->second.count;
        } else if (ignored_.size() < kMaxIgnoredKinds) {
            ignored_.emplace(kind, Ignored{line_, 1});
        } else {
            others_.line = others_.count++ == 0 ? line_ : others_.line;
        }
    }

    void reportIgnored() {
        if (faultyNormals_.count > 0) {
            warn(out_.warnings, lineName(faultyNormals_.line),
                 counted(faultyNormals_.count, "normal is missing or no direction",
                         "normals are missing or no directions, this being the first") +
                     "; the faces' own instead");
        }
        const auto report = [&](const Ignored& ignored, const std::string& what) {
            warn(out_.warnings, lineName(ignored.line),
                 what + " ignored" +
                     (ignored.count > 1 ? ", here and on " + counted(ignored.count - 1, "further line", "further lines")
                                        : ""));
        };
        for (const auto& [kind, ignored] : ignored_) {
            report(ignored, kind);
        }
        if (others_.count > 0) {
            report(others_, "other statements");
        }
    }

    /// What a file without faces is.
    [[nodiscard]] std::string nameOfNoFaces() const {
        const char* what = lines_ ? (points_ ? "points and lines" : "lines") : "points";
        return (positions_.empty() ? std::string("empty") : std::string("nothing but ") + what) +
               ": no faces, so there is no surface";
    }

    static std::string cornerName(size_t line, size_t corner) {
        return lineName(line) + ": face corner " + std::to_string(corner + 1);
    }

    static constexpr int64_t kEdgeAndCorner = 1; ///< OpenSubdiv's shapes: 0 none, 1 edges and corners, 2 edges

    struct Ignored {
        size_t line = 0; ///< the first
        size_t count = 0;
    };

    PartCage& part_;
    Character& out_;
    size_t line_ = 0;
    bool points_ = false; ///< there are statements p
    bool lines_ = false;  ///< l
    uint32_t material_ = kNone;
    std::unordered_map<std::string, uint32_t> materials_;
    std::map<std::string, Ignored> ignored_;
    Ignored others_;
    Ignored faultyNormals_;

    // As the file has them.
    std::vector<glm::vec3> positions_;
    std::vector<glm::vec2> uvs_;
    std::vector<glm::vec3> normals_;
    std::vector<Corner> corners_;
    std::vector<uint32_t> faceStarts_{0};
    std::vector<uint32_t> faceMaterials_;
    std::vector<size_t> faceLines_;
    std::vector<uint8_t> faceIsWhole_; ///< else it is left out
    std::vector<uint32_t> places_;     ///< by face: which of the cage's it is, or kNone
    std::vector<TaggedCrease> creases_;
    std::vector<TaggedCorner> sharpVertices_;
    std::vector<TaggedHole> holes_;
    Leniency leniency_;
};

} // namespace

Result<Character> readObj(std::span<const std::byte> bytes, const std::string& name, const FinishOptions& options) {
    const auto failure = [&](ErrorCode code, const std::string& message) {
        return Error{code, oneLine(name + ": " + message)};
    };
    try {
        Character character;
        character.name = name;
        std::vector<PartCage> parts(1);
        PartCage& part = parts.front();
        part.element = "file";
        part.part.polygonSource = PolygonSource::obj;
        ObjParser(part, options.strict, character).parse({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        bindToOneJoint(part, character, std::filesystem::path(name).stem().string());
        finishCharacter(std::move(parts), options, character);
        return character;
    } catch (const Refusal& refusal) {
        return asError(refusal, name);
    } catch (const std::bad_alloc&) {
        return failure(ErrorCode::hostMemory, "file: out of memory");
    } catch (const std::exception& error) {
        return failure(ErrorCode::asset, std::string("file: ") + error.what());
    }
}

} // namespace supple::cage
