#include "tools/bench/report.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <vector>

namespace supple::bench {

using Json = nlohmann::ordered_json;

namespace {

constexpr const char* kTargetNote =
    "The AVX2 loop evaluates plain bicubic patches and nothing else: it is a measure on the sphere, where nearly all "
    "patches are\nof that kind, and judged there alone. Crowds are judged on GPUs, ratios on CPU devices.\n";

/// Three significant digits, and no exponent: times and ratios of all sizes in one column.
std::string number(const Json& value) {
    if (!value.is_number()) {
        return "";
    }
    const double x = value.get<double>();
    char text[32];
    std::snprintf(text, sizeof text, x >= 100 ? "%.0f" : x >= 10 ? "%.1f" : x >= 0.1 || x == 0 ? "%.2f" : "%.4f", x);
    return text;
}

class Table {
public:
    explicit Table(std::vector<std::string> head) { add(std::move(head)); }
    void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
    [[nodiscard]] bool empty() const { return rows_.size() < 2; }

    /// Columns padded to one width; numbers, which is all but the first `words` columns, to the right.
    [[nodiscard]] std::string text(size_t words = 1) const {
        std::vector<size_t> widths(rows_.front().size(), 3);
        for (const std::vector<std::string>& row : rows_) {
            for (size_t c = 0; c < row.size(); ++c) {
                widths[c] = std::max(widths[c], row[c].size());
            }
        }
        std::string out;
        for (size_t r = 0; r < rows_.size(); ++r) {
            out += "|";
            for (size_t c = 0; c < widths.size(); ++c) {
                const std::string cell = c < rows_[r].size() ? rows_[r][c] : "";
                const std::string padding(widths[c] - cell.size(), ' ');
                out += " " + (c < words ? cell + padding : padding + cell) + " |";
            }
            out += "\n";
            if (r == 0) {
                out += "|";
                for (size_t c = 0; c < widths.size(); ++c) {
                    out += std::string(widths[c] + (c < words ? 2 : 1), '-') + (c < words ? "|" : ":|");
                }
                out += "\n";
            }
        }
        return out + "\n";
    }

private:
    std::vector<std::vector<std::string>> rows_;
};

std::vector<const Json*> rowsOf(const Json& result, const std::string& cage) {
    std::vector<const Json*> rows;
    for (const Json& row : result["rows"]) {
        if (row["cage"] == cage) {
            rows.push_back(&row);
        }
    }
    return rows;
}

/// A column a rate; a line for every name that `list` of any row holds.
std::string byRate(const std::vector<const Json*>& rows, const char* list, const char* value, const std::string& head) {
    std::vector<std::string> names, first{head};
    for (const Json* row : rows) {
        first.push_back("rate " + row->at("rate").dump());
        for (const Json& entry : row->at(list)) {
            const auto name = entry["name"].get<std::string>();
            if (std::find(names.begin(), names.end(), name) == names.end()) {
                names.push_back(name);
            }
        }
    }
    Table table(first);
    for (const std::string& name : names) {
        std::vector<std::string> line{name};
        bool any = false;
        for (const Json* row : rows) {
            std::string cell;
            for (const Json& entry : row->at(list)) {
                if (entry["name"] == name) {
                    cell = number(entry[value]);
                }
            }
            any = any || !cell.empty();
            line.push_back(cell);
        }
        if (any) {
            table.add(line);
        }
    }
    return table.empty() ? "" : table.text();
}

std::string cageTables(const Json& result, const std::string& cage) {
    const std::vector<const Json*> rows = rowsOf(result, cage);
    std::string out = "## " + cage + ", " + rows.front()->at("faces").dump() + " faces\n\n";
    out += byRate(rows, "contestants", "cpuNanosecondsPerPoint", "CPU ns a point");
    out += byRate(rows, "contestants", "wallNanosecondsPerPoint", "wall ns a point");
    out += byRate(rows, "contestants", "gpuNanosecondsPerPoint", "device timestamps, ns a point");
    out += byRate(rows, "ratios", "median", "median of the rounds' ratios");
    std::set<std::string> refusals; // most are of every rate
    for (const Json* row : rows) {
        for (const Json& refused : row->at("refused")) {
            refusals.insert(refused["scheme"].get<std::string>() +
                            " refuses it: " + refused["reason"].get<std::string>() + "\n\n");
        }
    }
    return std::accumulate(refusals.begin(), refusals.end(), out);
}

std::string loadingTable(const Json& result) {
    Table table({"loading, ms", "asset", "group", "parsed", "prepared elsewhere", "cooked", "hitch", "arriving",
                 "record", "first submit", "second", "us a face", "done, us a face", "bytes a face", "skin", "tables",
                 "index bytes"});
    for (const Json& one : result["loading"]) {
        table.add({one["cage"].get<std::string>() + ", " + one["scheme"].get<std::string>(),
                   number(one["createAssetMs"]), number(one["createGroupMs"]), number(one.value("parseMs", Json())),
                   number(one.value("prepareMs", Json())), number(one.value("cookedMs", Json())),
                   number(one.value("hitchMs", Json())), number(one.value("arriveMs", Json())), number(one["recordMs"]),
                   number(one["firstSubmitMs"]), number(one["secondSubmitMs"]), number(one["untilRecordedUsPerFace"]),
                   number(one.value("untilDoneUsPerFace", Json())), number(one["staticBytesPerFace"]),
                   number(one["deformBytesPerFace"]), number(one["tableBytesPerFace"]),
                   number(one.value("indexBytes", Json()))});
    }
    return table.empty() ? "" : table.text();
}

std::string pipelineTables(const Json& result) {
    Table sums({"pipelines, ms", "count", "created cold", "warm", "cold, side by side", "CPU cold", "warm",
                "first frame cold", "warm", "second frame", "warm-up", "first frame after it", "second"});
    Table each({"scheme", "pipeline", "SPIR-V bytes", "cold ms", "warm ms"});
    for (const Json& one : result["pipelines"]) {
        const std::string use = one.value("use", ""),
                          scheme = one["scheme"].get<std::string>() + (use.empty() ? "" : " " + use);
        sums.add({scheme + " on " + one["cage"].get<std::string>(), number(one["count"]), number(one["coldMs"]),
                  number(one["warmMs"]), number(one.value("sideBySideMs", Json())),
                  number(one.value("coldCpuMs", Json())), number(one.value("warmCpuMs", Json())),
                  number(one["coldFirstFrameMs"]), number(one["warmFirstFrameMs"]), number(one["warmSecondFrameMs"]),
                  number(one.value("warmUpMs", Json())), number(one.value("preparedFirstFrameMs", Json())),
                  number(one.value("preparedSecondFrameMs", Json()))});
        for (const Json& pipeline : one["pipelines"]) {
            each.add({scheme, pipeline["name"], pipeline["spirvBytes"].dump(), number(pipeline["coldMs"]),
                      number(pipeline["warmMs"])});
        }
    }
    return sums.empty() ? "" : sums.text() + each.text(2);
}

std::string crowdTable(const Json& crowd) {
    Table table({"characters", "scheme, rate", "evaluate, ms", "pose to vertices, ms", "us a character",
                 "evaluate, GB/s", "fill, GB/s", "store, GB/s", "share"});
    for (const Json& row : crowd["rows"]) {
        const double each = 1e3 * row["frameMs"].get<double>() / row["characters"].get<double>();
        const Json none;
        table.add({row["characters"].dump(), row["scheme"].get<std::string>() + ", rate " + row["rate"].dump(),
                   number(row["evaluateMs"]), number(row["frameMs"]), number(each),
                   number(row.value("evaluateGigabytesPerSecond", none)),
                   number(row.value("fillGigabytesPerSecond", none)),
                   number(row.value("storeGigabytesPerSecond", none)),
                   row.contains("bandwidthShare") ? number(row["bandwidthShare"]["median"]) : ""});
    }
    return "## Crowd: the " + crowd["character"].get<std::string>() + " of " + crowd["faces"].dump() + " faces with " +
           crowd["joints"].dump() + " joints, " + crowd["influences"].dump() + " influences a vertex\n\n" +
           (table.empty() ? "" : table.text(2));
}

/// A line a class, rate and way.
std::string kernelTable(const Json& rows) {
    Table table({"patches", "scheme", "cage", "way", "rate", "characters", "evaluate, ns", "/ first", "least",
                 "largest", "frame, ns", "/ first", "first frame, ms"});
    for (const Json& row : rows) {
        const std::string rate = row["rate"].is_string() ? row["rate"].get<std::string>() : row["rate"].dump();
        for (const Json& way : row["ways"]) {
            const bool hasFrame = way.contains("frameNs");
            table.add({row["class"], row["scheme"], row["cage"], way["way"], rate, row["characters"].dump(),
                       number(way["evaluateNs"]["median"]), number(way["evaluateRatio"]["median"]),
                       number(way["evaluateRatio"]["least"]), number(way["evaluateRatio"]["largest"]),
                       hasFrame ? number(way["frameNs"]["median"]) : "",
                       hasFrame ? number(way["frameRatio"]["median"]) : "", number(way["firstFrameMs"])});
        }
    }
    return table.empty() ? "" : "## Evaluation by classes of patches, a vertex\n\n" + table.text(4);
}

/// Passes that some row lacks are blank there.
std::string viewTable(const Json& rows) {
    std::vector<std::string> head{"scheme",    "characters",     "vertices",
                                  "frame, ms", "all unseen, ms", "as many more unseen add, %"},
        passes;
    for (const Json& row : rows) {
        for (const Json& pass : row["passes"]) {
            const std::string name = pass["pass"];
            if (std::find(passes.begin(), passes.end(), name) == passes.end()) {
                passes.push_back(name);
            }
        }
    }
    head.insert(head.end(), passes.begin(), passes.end());
    head.emplace_back("(level + place + attributes) / evaluate");
    Table table(head);
    for (const Json& row : rows) {
        std::vector<std::string> cells{
            row["scheme"],
            row["characters"].dump(),
            row["vertices"].dump(),
            number(row["frameMs"]),
            number(row["unseenMs"]),
            number(100.0 * (row["besideCulledMs"].get<double>() / row["aloneMs"].get<double>() - 1.0))};
        for (const std::string& name : passes) {
            const auto own = std::find_if(row["passes"].begin(), row["passes"].end(),
                                          [&](const Json& pass) { return pass["pass"] == name; });
            cells.push_back(own == row["passes"].end() ? "" : number((*own)["ms"]));
        }
        cells.push_back(number(row["aroundEvaluate"]));
        table.add(std::move(cells));
    }
    return table.empty() ? "" : "## The crowd in a view\n\n" + table.text();
}

std::string sceneTables(const Json& scene) {
    const auto megabytes = [](const Json& bytes) { return number(bytes.get<double>() / (1 << 20)); };
    const std::vector<std::string> costs{
        "dispatches", "barriers",  "copies",   "set, CPU us", "record, CPU us",    "alone",         "behind work",
        "cold",       "frame, ms", "vertices", "memory, MiB", "coefficients, MiB", "vertices, MiB", "allocations"};
    const auto addCosts = [&](const Json& row, std::vector<std::string>& cells) {
        cells.insert(cells.end(),
                     {row["dispatches"].dump(), row["barriers"].dump(), row["copies"].dump(), number(row["setUs"]),
                      number(row["recordUs"]), number(row["recordAloneUs"]), number(row["recordBehindWorkUs"]),
                      number(row["recordColdUs"]), number(row["frameMs"]), row["vertices"].dump(),
                      megabytes(row["memoryBytes"]), megabytes(row["coefficientBytes"]), megabytes(row["vertexBytes"]),
                      row["allocations"].dump()});
    };
    std::vector<std::string> head{"in", "poses", "characters"};
    head.insert(head.end(), costs.begin(), costs.end());
    head.emplace_back("all unseen, ms");
    Table rows(head);
    std::string refused;
    for (const Json& row : scene["rows"]) {
        std::vector<std::string> cells{row["use"], row["poses"], row["characters"].dump()};
        if (row.contains("refused")) {
            refused += cells[2] + " characters in a " + cells[0] + ", " + cells[1] +
                       ": refused: " + row["refused"].get<std::string>() + "\n\n";
            continue;
        }
        addCosts(row, cells);
        cells.push_back(number(row.value("unseenMs", Json())));
        rows.add(std::move(cells));
    }
    head = {"views", "characters"};
    head.insert(head.end(), costs.begin(), costs.end());
    head.insert(head.end(), {"levels and vertices of further views, ms", "the rest of these, ms"});
    Table views(head);
    for (const Json& row : scene["views"]) {
        std::vector<std::string> cells{row["views"].dump(), row["characters"].dump()};
        addCosts(row, cells);
        cells.insert(cells.end(), {number(row["ownMs"]), number(row["repeatedMs"])});
        views.add(std::move(cells));
    }
    return "## A scene of different characters, " + scene["instances"].dump() + " of each\n\n" +
           (rows.empty() ? "" : rows.text(2)) + refused + (views.empty() ? "" : views.text());
}

std::string updateRateTable(const Json& rows) {
    Table table({"poses", "characters", "posed a frame", "pose, ms", "/ without", "deform, ms", "/ without",
                 "record, CPU us", "device memory, KB an instance"});
    for (const Json& row : rows) {
        const auto interval = row["interval"].get<uint32_t>();
        const auto springs = row.value("springJoints", 0u), jiggling = row.value("jiggling", 0u);
        const auto cloth = row.value("cloth", 0u);
        const auto targets = row.value("morphTargets", 0u), drivers = row.value("drivers", 0u);
        const std::string what =
            springs > 0 && cloth > 0 ? std::to_string(springs) + " joints swing, " + std::to_string(jiggling) +
                                           " vertices jiggle, " + std::to_string(cloth) + " are cloth"
            : springs > 0   ? std::to_string(springs) + " joints swing"
            : jiggling > 0  ? std::to_string(jiggling) + " vertices jiggle"
            : cloth > 0     ? std::to_string(cloth) + " vertices are cloth"
            : drivers > 0   ? std::to_string(drivers) + " pose drivers of " + std::to_string(targets) + " morph targets"
            : targets > 0   ? std::to_string(targets) + " morph targets"
            : interval == 0 ? "without update rates"
            : interval == 1 ? "in every frame"
                            : "every " + std::to_string(interval) + " steps";
        table.add({what, row["characters"].dump(), number(row["posed"]), number(row["poseMs"]),
                   number(row["poseRatio"]), number(row["deformMs"]), number(row["deformRatio"]),
                   number(row["recordUs"]), number(row.value("instanceKb", Json()))});
    }
    return table.empty() ? "" : "## Update rates, springs, pose drivers\n\n" + table.text(1);
}

std::string pointTable(const Json& rows) {
    Table table({"points", "characters", "points pass, ms", "ns a point", "deform, ms"});
    for (const Json& row : rows) {
        table.add({row["points"].dump(), row["characters"].dump(), number(row["pointsMs"]), number(row["nsAPoint"]),
                   number(row["deformMs"])});
    }
    return table.empty() ? "" : "## Points on surfaces\n\n" + table.text(0);
}

std::string queryTable(const Json& rows) {
    Table table({"rays", "characters", "queries pass, ms", "rays a second", "CPU, ms", "CPU / pass"});
    for (const Json& row : rows) {
        table.add({row["rays"].dump(), row["characters"].dump(), number(row["queriesMs"]), number(row["raysASecond"]),
                   number(row["cpuMs"]), number(row["cpuOverQueries"])});
    }
    return table.empty() ? "" : "## Queries\n\n" + table.text(0);
}

/// Nanoseconds a vertex, and over dual quaternions.
std::string skinningTable(const Json& rows) {
    Table table({"deform pass", "vertices", "joints", "influences", "characters", "skinning", "ns a vertex",
                 "/ dual quaternions", "least", "largest"});
    for (const Json& row : rows) {
        for (const Json& way : row["ways"]) {
            table.add({row["cage"], row["vertices"].dump(), row["joints"].dump(), number(row["influences"]),
                       row["characters"].dump(), way["skinning"], number(way["nanosecondsPerVertex"]),
                       number(way["overDualQuaternions"]), number(way["least"]), number(way["largest"])});
        }
    }
    return table.empty() ? "" : "## Skinning\n\n" + table.text();
}

/// The dense mesh first, then its skin, then cage and surface.
void addClassicalLines(const Json& row, Table& table) {
    const std::string where = row["cage"].get<std::string>() + ", rate " + row["rate"].dump();
    const auto ratio = [&](const Json& name, const char* over) {
        for (const Json& one : row["ratios"]) {
            if (one["name"] == name.get<std::string>() + " / " + over) {
                return number(one["median"]) + " (" + number(one["least"]) + "-" + number(one["largest"]) + ")";
            }
        }
        return std::string();
    };
    const auto kilobytes = [](const Json& bytes) { return number(bytes.get<double>() / 1e3); };
    bool isDense = true;
    for (const Json& one : row["contestants"]) {
        table.add({where, one["name"], number(one["frameMs"]), number(one["frameCpuMs"]),
                   ratio(one["name"], "polygons"), ratio(one["name"], "polygons, skin alone"), one["vertices"].dump(),
                   kilobytes(one["loadedBytes"]), kilobytes(one["characterBytes"]), kilobytes(one["poseBytes"]),
                   kilobytes(one["fileBytes"])});
        if (isDense) {
            table.add({where, "polygons, skin alone", number(row["skinAloneMs"]), number(row["skinAloneCpuMs"])});
        }
        isDense = false;
    }
}

std::string classicalTables(const Json& rows) {
    Table table({"character", "drawn as", "frame, ms", "CPU ms", "/ polygons", "/ its skin", "vertices", "loaded, KB",
                 "a character, KB", "a pose, KB", "file, KB"});
    std::string crowds;
    for (const Json& row : rows) {
        crowds += row["cage"].get<std::string>() + ", rate " + row["rate"].dump() + ": " + row["characters"].dump() +
                  " characters of " + row["triangles"].dump() + " triangles, " + row["faces"].dump() + " faces, " +
                  row["joints"].dump() + " joints\n";
        for (const Json& refused : row["refused"]) {
            crowds +=
                refused["scheme"].get<std::string>() + " refuses it: " + refused["reason"].get<std::string>() + "\n";
        }
        addClassicalLines(row, table);
    }
    return table.empty()
               ? ""
               : "## The classical path: a dense skinned mesh of as many triangles\n\n" + crowds + "\n" + table.text(2);
}

/// A line a target and limit: in how many places it is met, and where the value is worst.
std::string targetTable(const Json& result) {
    struct Line {
        std::string what, limit;
        uint32_t places = 0, met = 0;
        const Json* worst = nullptr;
    };
    std::vector<Line> lines;
    for (const Json& target : result["targets"]) {
        const bool atLeast = target.value("atLeast", false);
        const std::string what = target["what"], limit = (atLeast ? "at least " : "at most ") + number(target["limit"]);
        auto line = std::find_if(lines.begin(), lines.end(),
                                 [&](const Line& known) { return known.what == what && known.limit == limit; });
        if (line == lines.end()) {
            line = lines.insert(line, {what, limit, 0, 0, nullptr});
        }
        ++line->places;
        line->met += target["met"] ? 1 : 0;
        if (line->worst == nullptr ||
            (atLeast ? target["value"] < (*line->worst)["value"] : target["value"] > (*line->worst)["value"])) {
            line->worst = &target;
        }
    }
    Table table({"target", "worst at", "worst", "limit", "met in"});
    for (const Line& line : lines) {
        table.add({line.what, (*line.worst)["where"], number((*line.worst)["value"]), line.limit,
                   std::to_string(line.met) + " of " + std::to_string(line.places)});
    }
    return table.empty() ? "" : table.text(2) + kTargetNote;
}

} // namespace

std::string whyNoResult(const Json& json) {
    for (const char* key : {"machine", "rounds", "rows", "peers"}) {
        if (!json.is_object() || !json.contains(key)) {
            return std::string("has no \"") + key + "\"";
        }
    }
    for (const Json& row : json["rows"]) {
        if (!row.is_object() || !row.contains("cage") || !row.contains("rate") || !row.contains("ratios")) {
            return "has a row without cage, rate or ratios";
        }
        for (const Json& ratio : row["ratios"]) {
            const auto isText = [&](const char* key) { return ratio.contains(key) && ratio[key].is_string(); };
            if (!ratio.is_object() || !isText("name") || !isText("of") || !isText("over") ||
                !ratio.contains("median") || !ratio["median"].is_number()) {
                return "has a ratio without name, of, over or median";
            }
        }
    }
    return "";
}

std::string toTables(const Json& result) {
    const Json& machine = result["machine"];
    const auto text = [](const Json& value) { return value.get<std::string>(); };
    std::string out = "device  " + text(machine["device"]) + ", " + text(machine["driver"]) + " " +
                      text(machine["driverInfo"]) + ", " + text(machine["mapping"]) + " mapping\n" + "CPU     " +
                      text(machine["cpu"]) + ", " + machine["threads"].dump() + " threads\n" + "rounds  " +
                      result["rounds"].dump() + ", medians; timestamps off but for their own table\n";
    for (const auto& [name, what] : result["peers"].items()) {
        out += "peer    " + name + ": " + text(what) + "\n";
    }
    for (const Json& one : result.value("leftOut", Json::array())) {
        out += "left out: " + text(one["what"]) + ": " + text(one["reason"]) + "\n";
    }
    if (!result.value("complete", true)) {
        out += "not complete: the run ended early\n";
    }
    for (const Json& one : result["agreement"]) {
        char difference[64];
        std::snprintf(difference, sizeof difference, "%.2g (at most %.0e)", one["difference"].get<double>(),
                      one["bound"].get<double>());
        out += "agree   " + text(one["what"]) + ": " + difference + "\n";
    }
    out += "\n";
    std::vector<std::string> cages;
    for (const Json& row : result["rows"]) {
        const auto cage = row["cage"].get<std::string>();
        if (std::find(cages.begin(), cages.end(), cage) == cages.end()) {
            cages.push_back(cage);
            out += cageTables(result, cages.back());
        }
    }
    if (result.contains("crowd")) {
        out += crowdTable(result["crowd"]);
    }
    out += kernelTable(result.value("kernels", Json::array()));
    out += viewTable(result.value("views", Json::array()));
    out += updateRateTable(result.value("updateRates", Json::array()));
    out += pointTable(result.value("points", Json::array()));
    out += queryTable(result.value("queries", Json::array()));
    if (result.contains("scene")) {
        out += sceneTables(result["scene"]);
    }
    out += skinningTable(result.value("skinning", Json::array()));
    out += classicalTables(result.value("classical", Json::array()));
    out += "## Loading, pipelines, targets\n\n" + loadingTable(result) + pipelineTables(result) + targetTable(result);
    return out;
}

} // namespace supple::bench
