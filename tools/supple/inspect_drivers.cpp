#include "tools/supple/inspect_drivers.h"

#include "cage/message.h"
#include "cage/solved_driver.h"

#include <cstdio>

namespace supple::tools {

nlohmann::ordered_json driversToJson(const cage::Character& character) {
    using Json = nlohmann::ordered_json;
    Json list = Json::array();
    for (const cage::PoseDriver& driver : character.drivers) {
        Json entry = {{"name", driver.name}, {"inputs", Json::array()}, {"morphTargets", Json::array()}};
        for (const cage::DriverInput& input : driver.inputs) {
            entry["inputs"].push_back(
                {{"node", character.skeleton.nodes[input.node].name}, {"part", cage::turnPartName(input.part)}});
        }
        for (const uint32_t target : driver.targets) {
            entry["morphTargets"].push_back(character.morphs.targets[target].name);
        }
        entry["poses"] = driver.poseCount();
        if (const Result<cage::SolvedDriver> solved = cage::solveDriver(driver)) {
            entry["condition"] = solved->condition;
            entry["closestDegrees"] = solved->closestDegrees;
        }
        list.push_back(std::move(entry));
    }
    return list;
}

std::vector<std::string> driverLines(const cage::Character& character) {
    std::vector<std::string> lines;
    for (const cage::PoseDriver& driver : character.drivers) {
        std::string line = (driver.name.empty() ? "nameless" : driver.name) + "  ";
        for (const cage::DriverInput& input : driver.inputs) {
            line += std::string(&input == driver.inputs.data() ? "" : ", ") + cage::turnPartName(input.part) + " of " +
                    character.skeleton.nodes[input.node].name;
        }
        line += ": " + cage::counted(driver.poseCount(), "pose", "poses") + ", " +
                cage::counted(driver.targets.size(), "morph target", "morph targets");
        if (const Result<cage::SolvedDriver> solved = cage::solveDriver(driver)) {
            char text[32];
            std::snprintf(text, sizeof text, ", condition %.2g", solved->condition);
            line += text;
        }
        lines.push_back(std::move(line));
    }
    return lines;
}

} // namespace supple::tools
