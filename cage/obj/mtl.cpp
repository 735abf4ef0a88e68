#include "cage/obj/mtl.h"

#include "cage/obj/text.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace supple::cage::obj {
namespace {

/// Statements of other kinds that a material names in its warning.
constexpr size_t kMaxUnusedKinds = 32;

/// How many numbers follow an option of a map at most, and whether words follow that are no numbers.
struct MapOption {
    std::string_view name;
    int numbers;
    int words;
};
constexpr MapOption kMapOptions[] = {
    {"-blendu", 0, 1}, {"-blendv", 0, 1},  {"-boost", 1, 0}, {"-bm", 1, 0},         {"-cc", 0, 1},
    {"-clamp", 0, 1},  {"-imfchan", 0, 1}, {"-mm", 2, 0},    {"-o", 3, 0},          {"-s", 3, 0},
    {"-t", 3, 0},      {"-texres", 1, 0},  {"-type", 0, 1},  {"-colorspace", 0, 1},
};

bool parseNumber(std::string_view word, float& value) {
    double number = 0.0;
    if (!parseWhole(word, number) || !std::isfinite(static_cast<float>(number))) {
        return false;
    }
    value = static_cast<float>(number);
    return true;
}

class MtlParser {
public:
    MtlParser(const std::function<bool(const std::string&)>& isWanted, std::vector<MtlMaterial>& materials)
        : isWanted_(isWanted), materials_(materials) {}

    void parse(std::string_view text) {
        if (text.starts_with("\xEF\xBB\xBF")) {
            text.remove_prefix(3);
        }
        for (Lines lines(text); lines.next();) {
            Words words(lines.line());
            const std::string_view keyword = words.next();
            if (keyword == "newmtl") {
                const std::string name(words.tail());
                isTaken_ = isWanted_(name);
                if (isTaken_) {
                    materials_.emplace_back().name = name;
                }
            } else if (isTaken_ && !keyword.empty() && !parseStatement(keyword, words)) {
                faulty_.add([&] { return lineName(lines.number()); });
            }
        }
    }
    [[nodiscard]] const Found& faulty() const { return faulty_; }

private:
    /// False if it makes no sense.
    bool parseStatement(std::string_view keyword, Words& words) {
        MtlMaterial& material = materials_.back();
        if (keyword == "Kd" || keyword == "Ke") {
            return parseColor(words, keyword == "Kd" ? material.diffuse : material.emission);
        }
        if (keyword == "d") {
            return parseScalar(words, material.dissolve);
        }
        if (keyword == "Tr") { // d wins, in either order
            std::optional<float> transparency;
            const bool sound = parseScalar(words, transparency);
            if (sound && !material.dissolve) {
                material.dissolve = 1.0f - *transparency;
            }
            return sound;
        }
        if (keyword == "Ns" || keyword == "Pr" || keyword == "Pm") {
            return parseScalar(words, keyword == "Ns"   ? material.shininess
                                      : keyword == "Pr" ? material.roughness
                                                        : material.metallic);
        }
        if (MtlMap* map = mapOf(keyword, material)) {
            return parseMap(words, *map);
        }
        if (material.unused.size() < kMaxUnusedKinds) {
            material.unused.emplace(keyword.substr(0, kMaxQuotedText));
        }
        return true;
    }

    static MtlMap* mapOf(std::string_view keyword, MtlMaterial& material) {
        if (keyword == "map_Kd") {
            return &material.diffuseMap;
        }
        if (keyword == "map_Ke") {
            return &material.emissionMap;
        }
        if (keyword == "map_d") {
            return &material.alphaMap;
        }
        if (keyword == "map_bump" || keyword == "map_Bump" || keyword == "bump") {
            return &material.bumpMap;
        }
        return keyword == "norm" ? &material.normalMap : nullptr;
    }

    static bool parseScalar(Words& words, std::optional<float>& value) {
        float number = 0.0f;
        if (!parseNumber(words.next(), number)) {
            return false;
        }
        value = number;
        return true;
    }

    /// One number alone is a grey.
    static bool parseColor(Words& words, std::optional<glm::vec3>& value) {
        glm::vec3 color;
        if (!parseNumber(words.next(), color.x)) {
            return false;
        }
        color = glm::vec3(color.x);
        for (int k = 1; k < 3; ++k) {
            const std::string_view word = words.next();
            if (!word.empty() && !parseNumber(word, color[k])) {
                return false;
            }
        }
        value = color;
        return true;
    }

    /// Options, then the file's name, which may have spaces.
    static bool parseMap(Words& words, MtlMap& out) {
        MtlMap map;
        for (;;) {
            const std::string_view tail = words.tail();
            if (tail.empty()) {
                return false;
            }
            const std::string_view word = words.next();
            const auto* option = std::find_if(std::begin(kMapOptions), std::end(kMapOptions),
                                              [&](const MapOption& known) { return known.name == word; });
            if (option == std::end(kMapOptions)) {
                map.file = tail;
                out = map;
                return true;
            }
            parseOption(*option, words, map);
        }
    }

    static void parseOption(const MapOption& option, Words& words, MtlMap& map) {
        std::array<float, 3> numbers{};
        int count = 0;
        while (count < option.numbers) {
            const Words before = words;
            if (!parseNumber(words.next(), numbers[static_cast<size_t>(count)])) {
                words = before; // fewer numbers than there may be: the name begins
                break;
            }
            ++count;
        }
        for (int i = 0; i < option.words; ++i) {
            const std::string_view word = words.next();
            map.clamp = option.name == "-clamp" ? word == "on" : map.clamp;
        }
        if (option.name == "-o") {
            map.offset = {count > 0 ? numbers[0] : 0.0f, count > 1 ? numbers[1] : 0.0f};
        } else if (option.name == "-s") {
            map.scale = {count > 0 ? numbers[0] : 1.0f, count > 1 ? numbers[1] : 1.0f};
        } else if (option.name == "-bm" && count > 0) {
            map.multiplier = numbers[0];
        }
    }

    const std::function<bool(const std::string&)>& isWanted_;
    std::vector<MtlMaterial>& materials_;
    bool isTaken_ = false; ///< whether lines are of the last of `materials`
    Found faulty_;
};

} // namespace

std::vector<MtlMaterial> parseMtl(std::string_view text, const std::function<bool(const std::string& name)>& isWanted,
                                  const std::string& element, Warnings& warnings) {
    std::vector<MtlMaterial> materials;
    MtlParser parser(isWanted, materials);
    parser.parse(text);
    if (parser.faulty().count > 0) {
        warn(warnings, element,
             parser.faulty().told("statement makes no sense", "statements make no sense") + "; left out");
    }
    return materials;
}

} // namespace supple::cage::obj
