#include "tools/supple/baked_patches.h"

#include "surface/choice.h"
#include "surface/patch_class.h"
#include "tools/common/schemes.h"
#include "tools/supple/bezier_net.h"
#include "tools/supple/text_file.h"

#include <map>
#include <span>

namespace supple::tools {
namespace {

surface::PatchClass classOf(const SupplePatchInfo& info) {
    return static_cast<surface::PatchClass>(info.patchClass);
}

/// What the patch pass wrote for a patch. p-rep's always come as 16 g, 16 h; a regular patch's h are zero.
std::vector<glm::vec3> storedCoefficients(const EvaluatedSurface& surface, uint64_t patch) {
    const bool prep = surface.output.surface.scheme == SUPPLE_SCHEME_PREP;
    const uint64_t count = prep ? SUPPLE_PATCH_STRIDE : surface.patches[patch].coefficientCount;
    std::vector<glm::vec3> stored;
    for (uint64_t i = 0; i < count; ++i) {
        stored.push_back(element<glm::vec3>(surface.coefficients, surface.output.surface.patchCoefficients,
                                            patch * SUPPLE_PATCH_STRIDE + i));
    }
    return stored;
}

template <class Vec>
void writeCoefficients(TextFile& file, std::span<const Vec> coefficients) {
    file.text("\"coefficients\":[");
    const char* separator = "[";
    for (const Vec& value : coefficients) {
        file.text(separator).number(value.x).text(",").number(value.y).text(",").number(value.z).text("]");
        separator = ",[";
    }
    file.text("]}");
}

void writePatch(TextFile& file, const EvaluatedSurface& surface, uint64_t patch, PatchBasis basis) {
    const SupplePatchInfo& info = surface.patches[patch];
    file.text("{\"face\":").number(uint64_t{info.face});
    file.text(",\"class\":\"").text(surface::className(classOf(info))).text("\",\"corners\":[");
    for (uint32_t i = 0; i < info.cornerCount; ++i) {
        file.text(i == 0 ? "" : ",").number(uint64_t{info.corners[i]});
    }
    file.text("],");
    const std::vector<glm::vec3> stored = storedCoefficients(surface, patch);
    if (basis == PatchBasis::stored) {
        writeCoefficients<glm::vec3>(file, stored);
        return;
    }
    const BezierNet net = bezierNet(classOf(info), stored).value_or(BezierNet());
    file.text("\"degree\":").number(uint64_t{net.degree}).text(",");
    writeCoefficients<glm::dvec3>(file, net.coefficients);
}

/// "; pm, prep have"
std::string whichHave() {
    std::string names;
    for (const Scheme& scheme : kSchemes) {
        if (scheme.coefficients) {
            names += (names.empty() ? "; " : ", ") + std::string(scheme.name);
        }
    }
    return names + " have";
}

} // namespace

std::string whyNoPatches(const cage::Character& character, const SurfaceFlags& flags,
                         const std::vector<SuppleScheme>& partSchemes) {
    const SuppleScheme named = schemeOf(flags.scheme);
    if (partSchemes.empty() && named != SUPPLE_SCHEME_AUTO) {
        return hasCoefficients(named) ? "" : "--patches: " + flags.scheme + " has no patch coefficients" + whichHave();
    }
    const std::vector<surface::SchemeChoice> choices = surface::chooseSchemes(character);
    for (size_t part = 0; part < choices.size(); ++part) {
        SuppleScheme scheme = partSchemes.empty() ? SUPPLE_SCHEME_AUTO : partSchemes[part];
        scheme = scheme == SUPPLE_SCHEME_AUTO ? named : scheme;
        scheme = scheme == SUPPLE_SCHEME_AUTO ? static_cast<SuppleScheme>(choices[part].scheme) : scheme;
        if (!hasCoefficients(scheme)) {
            return "--patches: part " + std::to_string(part) + " has scheme " + schemeName(scheme) +
                   ", which has no patch coefficients" + whichHave();
        }
    }
    return {};
}

Status checkBasis(const Evaluation& baked, PatchBasis basis) {
    if (basis == PatchBasis::stored) {
        return success();
    }
    std::map<std::string, size_t> others;
    uint32_t first = 0;
    for (const EvaluatedSurface& surface : baked.surfaces) {
        for (const SupplePatchInfo& info : surface.patches) {
            if (!hasBezierNet(classOf(info))) {
                first = others.empty() ? info.face : first;
                ++others[surface::className(classOf(info))];
            }
        }
    }
    if (others.empty()) {
        return success();
    }
    std::string counts;
    for (const auto& [name, count] : others) {
        counts += (counts.empty() ? "" : ", ") + std::to_string(count) + " " + name;
    }
    return Error{ErrorCode::asset, "--basis bezier: " + counts + ", the first of face " + std::to_string(first) +
                                       ": these patches are no tensor products, but triangles of degree 4 "
                                       "(docs/pm.md); --basis stored writes them, and all of prep's are"};
}

Status writePatches(const std::string& path, const Evaluation& baked, PatchBasis basis) {
    std::string schemes;
    for (const EvaluatedSurface& surface : baked.surfaces) {
        schemes += (schemes.empty() ? "" : "+") + std::string(schemeName(surface.output.surface.scheme));
    }
    TextFile file(path);
    file.text("{\"scheme\":\"").text(schemes).text(basis == PatchBasis::bezier ? "\",\"basis\":\"bezier" : "");
    file.text("\",\"rate\":").number(uint64_t{baked.surfaces.front().output.grid.rate}).text(",\"patches\":[");
    const char* separator = "\n";
    for (const EvaluatedSurface& surface : baked.surfaces) {
        for (uint64_t patch = 0; patch < surface.output.surface.patchCount; ++patch) {
            file.text(separator);
            writePatch(file, surface, patch, basis);
            separator = ",\n";
        }
    }
    file.text("\n]}\n");
    return file.close();
}

} // namespace supple::tools
