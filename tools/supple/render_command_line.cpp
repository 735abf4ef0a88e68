#include "tools/supple/render_command_line.h"

#include "tools/common/formatted.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>

namespace supple::tools {

namespace {

std::string quoted(const std::string& text) {
    const auto isPlain = [](unsigned char c) {
        return std::isalnum(c) != 0 ||
               std::string_view("_-./,=:+#").find(static_cast<char>(c)) != std::string_view::npos;
    };
    if (!text.empty() && std::all_of(text.begin(), text.end(), isPlain))
        return text;
    std::string inQuotes = "'";
    for (const char c : text)
        inQuotes += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return inQuotes + "'";
}

/// As few digits as lead back to the same number, so that the same picture comes out.
std::string numberText(double value) {
    const std::string brief = formatted("%.9g", value);
    return std::strtod(brief.c_str(), nullptr) == value ? brief : formatted("%.17g", value);
}

class Words {
public:
    explicit Words(const std::string& first) : text_(first) {}
    Words& add(const std::string& word) {
        text_ += " " + quoted(word);
        return *this;
    }
    void option(const char* name, const std::string& value, const std::string& usual) {
        if (value != usual)
            add(name).add(value);
    }
    void option(const char* name, double value, double usual) {
        if (value != usual)
            add(name).add(numberText(value));
    }
    void flag(const char* name, bool given) {
        if (given)
            add(name);
    }
    [[nodiscard]] const std::string& text() const { return text_; }

private:
    std::string text_;
};

const char* schemeWord(SuppleScheme scheme) {
    const auto known =
        std::find_if(std::begin(kSchemes), std::end(kSchemes), [&](const Scheme& row) { return row.scheme == scheme; });
    return known != std::end(kSchemes) ? known->name : "auto";
}

void addReading(Words& words, const host::ReadOptions& reading) {
    words.flag("--pair-quads", reading.pairQuads);
    words.flag("--keep-triangles", reading.keepTriangles);
    words.flag("--parts-apart", reading.partsApart);
    words.flag("--vertices-apart", reading.verticesApart);
    words.flag("--creases-from-normals", reading.creasesFromNormals);
    words.flag("--smooth", reading.smooth);
    words.flag("--strict", reading.strict);
    if (reading.memoryLimit != 0)
        words.add("--memory-limit").add(std::to_string(reading.memoryLimit));
    if (reading.scene)
        words.add("--scene").add(std::to_string(*reading.scene));
    if (!reading.variant.empty())
        words.add("--variant").add(reading.variant);
    if (!reading.clipFiles.empty())
        words.add("--clips");
    for (const std::string& clips : reading.clipFiles)
        words.add(clips);
    words.option("--retarget", reading.retargeting, host::ReadOptions{}.retargeting);
    words.option("--retarget-map", reading.retargetMap, {});
}

void addDraw(Words& words, const DrawOptions& draw) {
    const DrawOptions usual;
    words.option("--scheme", draw.scheme, usual.scheme);
    for (const host::PartScheme& setting : draw.partSchemes)
        words.add("--part-scheme").add(setting.part + "=" + schemeWord(setting.scheme));
    words.option("--rate", draw.rate, usual.rate);
    words.option("--skinning", draw.skinning, usual.skinning);
    words.option("--creases", draw.creases, usual.creases);
    words.option("--sharp", double{draw.sharpThreshold}, double{usual.sharpThreshold});
    words.option("--rules", draw.rules, usual.rules);
    words.option("--uv-mode", draw.uvMode, usual.uvMode);
    words.flag("--shared-samples", draw.sharedSamples);
    words.option("--view", draw.view, usual.view);
    words.option("--joint", draw.joint, usual.joint);
    words.flag("--cage", draw.cageOverlay);
    words.flag("--springs", draw.soft.springs);
    words.flag("--colliders", draw.soft.colliders);
    words.flag("--painted", draw.soft.painted);
    words.flag("--split", draw.split);
    words.flag("--levels", draw.levels);
    words.option("--chord-error", double{draw.chordError}, double{usual.chordError});
    words.flag("--no-ground", !draw.ground);
    words.flag("--alpha", draw.alpha);
    words.option("--yaw", draw.yaw, usual.yaw);
    words.option("--pitch", draw.pitch, usual.pitch);
    for (const std::string& part : draw.parts)
        words.add("--part").add(part);
    for (const host::MorphSetting& morph : draw.morphs)
        words.add(morph.isExpression ? "--expression" : "--morph")
            .add(morph.target + formatted("=%.9g", double{morph.weight}));
    words.option("--device", draw.device, usual.device);
    words.option("--mapping", draw.mapping, usual.mapping);
    addReading(words, draw.reading);
}

/// What single pictures and animated ones have in common.
template <class Options>
void addPicture(Words& words, const Options& options) {
    const Options usual;
    words.add(options.file).add("-o").add(options.output);
    words.option("--size", options.size, usual.size);
    words.option("--clip", options.clip, usual.clip);
}

} // namespace

std::string commandLine(const RenderOptions& options) {
    const RenderOptions usual;
    Words words("supple render");
    addPicture(words, options);
    words.option("--time", options.time, usual.time);
    words.option("--zoom", options.zoom, usual.zoom);
    words.option("--at", options.at, usual.at);
    words.option("--eye", options.eye, usual.eye);
    words.option("--look-at", options.lookAt, usual.lookAt);
    words.option("--up", options.up, usual.up);
    words.option("--fov", options.fieldOfView, usual.fieldOfView);
    words.flag("--trace", options.draw.trace);
    addDraw(words, options.draw);
    return words.text();
}

std::string commandLine(const AnimateOptions& options) {
    const AnimateOptions usual;
    Words words("supple animate");
    addPicture(words, options);
    words.option("--fps", options.fps, usual.fps);
    words.option("--seconds", options.seconds, usual.seconds);
    words.option("--turn", options.turn, usual.turn);
    words.option("--quality", double{options.quality}, double{usual.quality});
    addDraw(words, options.draw);
    return words.text();
}

} // namespace supple::tools
