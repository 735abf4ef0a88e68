#include "cage/obj/parser.h"

#include "cage/corner_normals.h"
#include "cage/limits.h"
#include "cage/obj/text.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

namespace supple::cage::obj {
namespace {

/// Kinds of ignored statements that are told apart.
constexpr size_t kMaxIgnoredKinds = 8;

/// Which mark of UTF-16 the bytes have, or zeros as texts in it have: the upper half of each letter.
bool isUtf16(std::string_view text) {
    if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
        return true;
    }
    constexpr size_t kLooked = 64;
    const size_t looked = std::min(text.size(), kLooked) / 2 * 2;
    size_t zeros[2] = {0, 0};
    for (size_t i = 0; i < looked; ++i) {
        zeros[i % 2] += text[i] == '\0' ? 1 : 0;
    }
    return looked >= 4 && std::max(zeros[0], zeros[1]) == looked / 2 && std::min(zeros[0], zeros[1]) == 0;
}

float linearOfSrgb(float value) {
    return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

/// Names that statements select, each once.
class Selection {
public:
    explicit Selection(std::vector<std::string>& names) : names_(names) {}
    void select(std::string_view name) {
        const auto [known, isNew] = places_.try_emplace(std::string(name), static_cast<uint32_t>(names_.size()));
        if (isNew) {
            names_.emplace_back(name);
        }
        selected_ = known->second;
    }
    [[nodiscard]] uint32_t selected() const { return selected_; } ///< kNone: none yet

private:
    std::vector<std::string>& names_;
    std::unordered_map<std::string, uint32_t> places_;
    uint32_t selected_ = kNone;
};

class ObjParser {
public:
    ObjParser(Leniency& leniency, File& file) : leniency_(leniency), file_(file) {}

    void parse(std::string_view text) {
        for (Lines lines(text); lines.next();) {
            line_ = lines.number();
            parseLine(lines.line());
        }
        leniency_.raise();
        if (file_.faceLines.empty()) {
            leniency_.refuseAll({"file: " + nameOfNoFaces()});
        }
        checkCorners();
        checkTags();
        leniency_.raise();
    }

    void reportIgnored(Warnings& warnings) const {
        if (faultyNormals_.count > 0) {
            warn(warnings, lineName(faultyNormals_.line),
                 counted(faultyNormals_.count, "normal is missing or no direction",
                         "normals are missing or no directions, this being the first") +
                     "; the faces' own instead");
        }
        if (faultyColors_.count > 0) {
            warn(warnings, lineName(faultyColors_.line),
                 counted(faultyColors_.count, "color is not three numbers of 0 to 1",
                         "colors are not three numbers of 0 to 1, this being the first") +
                     "; left out");
        }
        const auto report = [&](const Ignored& ignored, const std::string& what) {
            warn(warnings, lineName(ignored.line),
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
            material_.select(words.tail());
        } else if (keyword == "o") {
            object_.select(words.tail());
        } else if (keyword == "g") {
            group_.select(words.tail());
        } else if (keyword == "mtllib") {
            parseLibrary(words);
        } else if (keyword == "t") {
            leniency_.leaveOut([&] { parseTag(words); });
        } else if (!keyword.empty() && keyword != "vp" && keyword != "s") {
            ignore(std::string(keyword.substr(0, kMaxQuotedText)));
        }
    }

    void parsePosition(Words& words) {
        const std::string element = lineName(line_);
        if (file_.positions.size() == kMaxVertices) {
            refuse(element, "more than " + std::to_string(kMaxVertices) + " vertices", ErrorCode::limit);
        }
        glm::vec3 position;
        for (int k = 0; k < 3; ++k) {
            position[k] = toFloat(words.next(), element + ": position");
            if (const char* fault = faultOfCoordinate(position[k])) {
                refuse(element + ": position", fault);
            }
        }
        file_.positions.push_back(position);
        parseColor(words);
    }

    /// A fourth number alone is a rational weight. Three behind the position are a color, sRGB, of which an alpha may
    /// follow.
    void parseColor(Words& words) {
        std::string_view texts[3];
        for (std::string_view& text : texts) {
            text = words.next();
        }
        glm::vec3 color = kNoColor;
        if (!texts[2].empty()) {
            bool sound = true;
            for (int k = 0; k < 3; ++k) {
                float value = 0.0f;
                sound = sound && parseWhole(texts[k], value) && value >= 0.0f && value <= 1.0f;
                color[k] = linearOfSrgb(value);
            }
            if (!sound) {
                color = kNoColor;
                faultyColors_.line = faultyColors_.count++ == 0 ? line_ : faultyColors_.line;
            }
        }
        if (color != kNoColor || !file_.colors.empty()) {
            file_.colors.resize(file_.positions.size() - 1, kNoColor);
            file_.colors.push_back(color);
        }
    }

    void parseUv(Words& words) {
        const std::string element = lineName(line_);
        if (file_.uvs.size() == kMaxCorners) {
            refuse(element, "more than " + std::to_string(kMaxCorners) + " texture coordinates", ErrorCode::limit);
        }
        glm::vec2 uv(0.0f, 1.0f);
        leniency_.leaveOut([&] {
            const float u = toFloat(words.next(), element + ": texture coordinate");
            const std::string_view second = words.next();
            const float v = second.empty() ? 0.0f : toFloat(second, element + ": texture coordinate");
            uv = {u, 1.0f - v};
        });
        file_.uvs.push_back(uv); // also a faulty one: the others keep their numbers
    }

    void addFaultyNormal(size_t line) {
        faultyNormals_.line = faultyNormals_.count++ == 0 ? line : faultyNormals_.line;
    }

    /// A cage needs no normals: one that is malformed becomes zero, which means none.
    void parseNormal(Words& words) {
        if (file_.normals.size() == kMaxCorners) {
            refuse(lineName(line_), "more than " + std::to_string(kMaxCorners) + " normals", ErrorCode::limit);
        }
        glm::dvec3 normal(0.0);
        bool sound = true;
        for (int k = 0; k < 3; ++k) {
            sound = parseWhole(words.next(), normal[k]) && sound;
        }
        file_.normals.push_back(sound ? unitNormal(normal) : glm::vec3(0.0f));
        if (file_.normals.back() == glm::vec3(0.0f)) {
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
        const size_t first = file_.corners.size();
        const bool isWhole = leniency_.leaveOut([&] { parseCorners(words, first); });
        if (!isWhole) {
            file_.corners.resize(first);
        }
        file_.faceIsWhole.push_back(isWhole ? 1 : 0);
        file_.faceStarts.push_back(static_cast<uint32_t>(file_.corners.size()));
        file_.faceMaterials.push_back(material_.selected());
        file_.faceObjects.push_back(object_.selected());
        file_.faceGroups.push_back(group_.selected());
        file_.faceLines.push_back(line_);
    }

    void parseCorners(Words& words, size_t first) {
        for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
            const std::string element = cornerName(line_, file_.corners.size() - first);
            if (file_.corners.size() == kMaxCorners) {
                refuse(element, "more than " + std::to_string(kMaxCorners) + " corners", ErrorCode::limit);
            }
            const size_t slash = std::min(word.find('/'), word.size());
            Corner corner;
            corner.vertex = resolve(word.substr(0, slash), file_.positions.size(), "vertex", element);
            const std::string_view behind = word.substr(std::min(slash + 1, word.size()));
            const std::string_view uv = behind.substr(0, behind.find('/'));
            if (!uv.empty()) {
                corner.uv = resolve(uv, file_.uvs.size(), "texture coordinate", element);
            }
            const std::string_view normal = behind.substr(std::min(uv.size() + 1, behind.size()));
            if (!normal.empty()) {
                corner.normal = resolve(normal, file_.normals.size(), "normal", element);
            }
            file_.corners.push_back(corner);
        }
    }

    void parseLibrary(Words& words) {
        const std::string text(words.tail());
        if (known_.insert(text).second) {
            file_.libraries.push_back({text, line_});
        }
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
                file_.holes.push_back({face, line_});
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
            file_.creases.push_back({vertices[i], vertices[i + 1], floats[floats.size() == 1 ? 0 : i], line_});
        }
    }

    void addSharpVertices(const std::vector<int64_t>& vertices, const std::vector<float>& floats,
                          const std::string& element) {
        if (vertices.empty() || (floats.size() != 1 && floats.size() != vertices.size())) {
            refuse(element, counted(floats.size(), "sharpness", "sharpnesses") + " for " +
                                counted(vertices.size(), "vertex", "vertices"));
        }
        for (size_t i = 0; i < vertices.size(); ++i) {
            file_.sharpVertices.push_back({vertices[i], floats[floats.size() == 1 ? 0 : i], line_});
        }
    }

    /// Tells of the first corner that is out of range, of each kind, and how many more there are. A face without a
    /// vertex is left out, a texture coordinate or a normal alone.
    void checkCorners() {
        Found vertices;
        Found uvs;
        for (size_t f = 0; f < file_.faceLines.size(); ++f) {
            const auto isMissing = [&](uint32_t corner, const char* what, uint32_t index, size_t count, Found& found) {
                if (index == kNone || index < count) {
                    return false;
                }
                found.add([&] {
                    return cornerName(file_.faceLines[f], corner - file_.faceStarts[f]) + ": " + what + " " +
                           std::to_string(index + 1) + " of " + std::to_string(count);
                });
                return true;
            };
            for (uint32_t c = file_.faceStarts[f]; c < file_.faceStarts[f + 1]; ++c) {
                if (isMissing(c, "vertex", file_.corners[c].vertex, file_.positions.size(), vertices)) {
                    file_.faceIsWhole[f] = 0;
                }
                if (isMissing(c, "texture coordinate", file_.corners[c].uv, file_.uvs.size(), uvs)) {
                    file_.corners[c].uv = kNone;
                }
                if (file_.corners[c].normal != kNone && file_.corners[c].normal >= file_.normals.size()) {
                    addFaultyNormal(file_.faceLines[f]);
                    file_.corners[c].normal = kNone;
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
        std::erase_if(file_.creases, [&](const TaggedCrease& tag) {
            const bool a = isMissing(tag.a, file_.positions.size(), "crease", "vertex", tag.line);
            const bool b = isMissing(tag.b, file_.positions.size(), "crease", "vertex", tag.line);
            return a || b;
        });
        std::erase_if(file_.sharpVertices, [&](const TaggedCorner& tag) {
            return isMissing(tag.vertex, file_.positions.size(), "corner", "vertex", tag.line);
        });
        std::erase_if(file_.holes, [&](const TaggedHole& tag) {
            return isMissing(tag.face, file_.faceLines.size(), "hole", "face", tag.line);
        });
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

    /// What a file without faces is.
    [[nodiscard]] std::string nameOfNoFaces() const {
        const char* what = lines_ ? (points_ ? "points and lines" : "lines") : "points";
        return (file_.positions.empty() ? std::string("empty") : std::string("nothing but ") + what) +
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

    Leniency& leniency_;
    File& file_;
    size_t line_ = 0;
    bool points_ = false; ///< there are statements p
    bool lines_ = false;  ///< l
    Selection material_{file_.materials};
    Selection object_{file_.objects};
    Selection group_{file_.groups};
    std::set<std::string> known_; ///< texts behind mtllib
    std::map<std::string, Ignored> ignored_;
    Ignored others_;
    Ignored faultyNormals_;
    Ignored faultyColors_;
};

} // namespace

File parse(std::string_view text, Leniency& leniency, Warnings& skipped) {
    if (isUtf16(text)) {
        refuse("file", "UTF-16; OBJ files are ASCII or UTF-8");
    }
    if (text.starts_with("\xEF\xBB\xBF")) {
        text.remove_prefix(3);
    }
    File file;
    ObjParser parser(leniency, file);
    parser.parse(text);
    parser.reportIgnored(skipped);
    return file;
}

} // namespace supple::cage::obj
