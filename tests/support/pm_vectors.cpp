#include "tests/support/pm_vectors.h"

#include "tests/support/json_vectors.h"
#include "tests/support/pm_surface.h"

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

namespace supple::test {
namespace {

using nlohmann::json;
using surface::PatchClass;
using surface::pm::FanKind;

PmVectors::Fan readFan(const json& j) {
    static const std::map<std::string, FanKind> kKinds{
        {"interior", FanKind::interior}, {"crease", FanKind::crease}, {"corner", FanKind::corner}};
    PmVectors::Fan fan;
    fan.vertex = j.at("vertex");
    fan.kind = kKinds.at(j.at("kind"));
    fan.valence = j.at("N");
    fan.edges = j.at("edges").get<std::vector<uint32_t>>();
    fan.faces = j.at("faces").get<std::vector<uint32_t>>();
    fan.v = jsonVector(j.at("v"));
    fan.tau1 = jsonVector(j.at("tau1"));
    fan.tau2 = jsonVector(j.at("tau2"));
    fan.t = jsonVectors(j.at("t"));
    fan.f = jsonVectors(j.at("f"));
    return fan;
}

PmVectors::Patch readPatch(const json& j) {
    static const std::map<std::string, PatchClass> kClasses{{"bicubic", PatchClass::regular},
                                                            {"polar", PatchClass::polar},
                                                            {"P3", PatchClass::p3},
                                                            {"P4", PatchClass::p4},
                                                            {"P5", PatchClass::p5}};
    PmVectors::Patch patch;
    patch.patchClass = kClasses.at(j.at("type"));
    patch.corners = j.at("corners").get<std::vector<uint32_t>>();
    patch.coefficients = jsonVectors(j.at("coef"));
    for (const json& s : j.at("samples")) {
        patch.samples.push_back({s.at("at").get<std::vector<double>>(), jsonVector(s.at("P")), jsonVector(s.at("N"))});
    }
    return patch;
}

PmVectors readPm(const json& j, const std::string&) {
    PmVectors v;
    v.name = j.at("name").get<std::string>();
    v.positions = jsonVectors(j.at("vertices"));
    v.cage = makeCage({v.positions.begin(), v.positions.end()}, j.at("faces_in").get<Faces>());
    for (const json& s : j.at("sharp")) {
        v.cage.creases.push_back({s.at(0), s.at(1), s.at(2)});
    }
    for (const json& corner : j.at("corners")) {
        v.cage.sharpVertices.push_back({corner, cage::kHardSharpness});
    }
    for (const json& a : j.at("alpha")) {
        v.alphas.push_back({a.at(0), a.at(1), a.at(2)});
        v.cage.creaseScalars.push_back({a.at(0), a.at(1), a.at(2)});
    }
    v.faces = j.at("faces").get<Faces>();
    v.sourceFaces = j.at("source_face").get<std::vector<uint32_t>>();
    v.apexes = j.at("polar").get<std::vector<uint32_t>>();
    for (const json& fan : j.at("sectors")) {
        v.fans.push_back(readFan(fan));
    }
    for (const json& patch : j.at("patches")) {
        v.patches.push_back(readPatch(patch));
    }
    return v;
}

} // namespace

surface::pm::Mesh PmVectors::mesh() const {
    surface::pm::Mesh mesh = pmMesh(cage);
    std::map<std::pair<uint32_t, uint32_t>, double> exact;
    for (const Alpha& a : alphas) {
        exact[{a.vertex, a.toward}] = a.alpha;
    }
    setAlphas(mesh, [&](uint32_t vertex, uint32_t toward, double rounded) {
        const auto alpha = exact.find({vertex, toward});
        return alpha == exact.end() ? rounded : alpha->second;
    });
    return mesh;
}

const std::vector<PmVectors>& pmVectors() {
    static const std::vector<PmVectors> kAll = readJsonFolder("pm", readPm);
    return kAll;
}

} // namespace supple::test
