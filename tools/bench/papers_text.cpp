#include "tools/bench/papers.h"
#include "tools/bench/printed_figures.h"
#include "tools/common/formatted.h"

#include <nlohmann/json.hpp>

namespace supple::bench {

using tools::formatted;

namespace {

constexpr uint32_t kSamples[] = {5, 9, 17, 33, 65};

std::string rateText(double perSecond) {
    return perSecond >= 1e5 ? formatted("%.2f M", 1e-6 * perSecond)
                            : formatted(perSecond < 10 ? "%.2f" : "%.0f", perSecond);
}

std::string classText(const nlohmann::ordered_json& classes) {
    std::string text;
    for (const auto& [name, count] : classes.items())
        text += (text.empty() ? "" : ", ") + std::to_string(count.get<uint32_t>()) + " " + name;
    return text;
}

std::string printedRowsOf(const std::string& model, const std::string& scheme) {
    std::string text;
    for (const PrintedRow& row : printedRows()) {
        if (row.model != model || row.scheme != scheme)
            continue;
        text += formatted("| printed (%s): %s, %s | |", row.paper, row.work, row.device);
        for (const uint32_t samples : kSamples) {
            std::string cell = "–";
            for (const PrintedRow::At& at : row.figures)
                cell = at.samples == samples ? rateText(at.framesPerSecond) : cell;
            text += " " + cell + " |";
        }
        text += "\n";
    }
    return text;
}

std::string modelText(const nlohmann::ordered_json& model) {
    const std::string name = model["name"];
    std::string text = formatted("## %s: %s, %u faces\n\n", name.c_str(), model["what"].get<std::string>().c_str(),
                                 model["faces"].get<uint32_t>());
    text += "| frames a second (triangles a second), N | patches |";
    for (const uint32_t samples : kSamples)
        text += formatted(" %u |", samples);
    text += "\n|---|---|--:|--:|--:|--:|--:|\n";
    for (const nlohmann::ordered_json& scheme : model["schemes"]) {
        const std::string word = scheme["scheme"];
        if (scheme["rows"].empty()) {
            text += "| " + word + " | " + scheme["refused"].get<std::string>() + " | | | | | |\n";
            continue;
        }
        text += "| " + word + " | " + classText(scheme["patches"]) + " |";
        for (const uint32_t samples : kSamples) {
            std::string cell = "–";
            for (const nlohmann::ordered_json& row : scheme["rows"]) {
                if (row["samples"] == samples)
                    cell = rateText(row["framesPerSecond"]) + " (" + rateText(row["trianglesPerSecond"]) + ")";
            }
            text += " " + cell + " |";
        }
        text += "\n" + printedRowsOf(name, word);
    }
    return text + "\n";
}

std::string blendText(const nlohmann::ordered_json& rows, bool cpuDevice) {
    std::string text =
        "## blend: evaluation alone, device and CPU\n\n| frames a second | faces | samples a face | device | one "
        "core | all cores | device / one core | device / all cores |\n|---|--:|--:|--:|--:|--:|--:|--:|\n";
    for (const nlohmann::ordered_json& row : rows) {
        const double device = row["device"], one = row["oneCore"], all = row["allCores"];
        const std::string overAll = cpuDevice ? "–" : formatted("%.2f", device / all); // it takes these cores itself
        text += formatted("| %s | %u | %u x %u | %.1f | %.1f | %.1f | %.2f | %s |\n",
                          row["model"].get<std::string>().c_str(), row["faces"].get<uint32_t>(),
                          row["samples"].get<uint32_t>(), row["samples"].get<uint32_t>(), device, one, all,
                          device / one, overAll.c_str());
    }
    for (const PrintedBlend& row : printedBlend())
        text +=
            formatted("| printed (2011): GeForce 6800 Ultra, Pentium 4 3.2 GHz | %u | 30 x 30 | %.1f | %.2f | – | %.1f "
                      "| – |\n",
                      row.faces, row.gpu, row.cpu, row.gpu / row.cpu);
    return text + "\n";
}

std::string accText(const nlohmann::ordered_json& models) {
    std::string text = "## ACC beside others: evaluation alone, and the distance to the Catmull-Clark limit\n\n"
                       "| | | ns a point | largest distance | mean |\n|---|---|--:|--:|--:|\n";
    for (const nlohmann::ordered_json& model : models) {
        for (const nlohmann::ordered_json& scheme : model["schemes"])
            text += formatted("| %s | %s | %.1f | %.1e | %.1e |\n", model["model"].get<std::string>().c_str(),
                              scheme["scheme"].get<std::string>().c_str(), scheme["nanosecondsPerPoint"].get<double>(),
                              scheme["largest"].get<double>(), scheme["mean"].get<double>());
    }
    return text + "\n";
}

} // namespace

std::string papersText(const nlohmann::ordered_json& result) {
    std::string text;
    for (const nlohmann::ordered_json& model : result["models"])
        text += modelText(model);
    text += "Printed of Loop in fragments (poster, 2005), over all its models and cards together: at depth 4 from 4.3 "
            "to 22.8 "
            "frames a\nsecond, at depth 5 from 1.9 to 15.6. Which model has which is not at hand.\n\n";
    return text + blendText(result["blend"], result["cpuDevice"].get<bool>()) + accText(result["acc"]);
}

} // namespace supple::bench
