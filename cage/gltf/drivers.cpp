#include "cage/gltf/drivers.h"

#include "cage/gltf/accessors.h"
#include "cage/gltf/deformers.h"
#include "cage/limits.h"
#include "cage/refusal.h"
#include "cage/solved_driver.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace supple::cage::gltf {
namespace {

constexpr double kCloseDegrees = 10.0;
constexpr double kHighCondition = 100.0;

/// What a driver is called in messages.
std::string placeOf(const std::string& list, size_t number, const std::string& name) {
    return item(list, number) + (name.empty() ? "" : " " + quoted(name));
}

class DriverReader {
public:
    DriverReader(const Document& document, const Skeleton& skeleton, size_t targetCount, const Json& from,
                 std::string place)
        : document_(document), skeleton_(skeleton), targetCount_(targetCount), from_(from), place_(std::move(place)) {}

    PoseDriver read(std::string name) && {
        driver_.name = std::move(name);
        readInputs();
        readTargets();
        readPoses();
        driver_.width = numberMember(from_, "width", driver_.width, kMinDriverWidth, kMaxDriverWidth, place_);
        readClamp();
        return std::move(driver_);
    }

private:
    /// Its entries: at least one, and no more than `most`.
    std::span<const Json> list(const char* key, size_t most) const {
        const Json* found = arrayMember(from_, key, place_);
        const size_t count = found != nullptr ? found->size() : 0;
        if (count == 0 || count > most) {
            refuse(place_ + " " + key, count == 0 ? std::string("there are none")
                                                  : std::to_string(count) + ", of at most " + std::to_string(most));
        }
        return found->items();
    }

    void readInputs() {
        const std::span<const Json> inputs = list("inputs", kMaxDriverInputs);
        for (size_t i = 0; i < inputs.size(); ++i) {
            driver_.inputs.push_back(readInput(inputs[i], item(place_ + " inputs", i)));
        }
    }

    DriverInput readInput(const Json& from, const std::string& element) const {
        if (!from.isObject()) {
            refuse(element, "not an object");
        }
        DriverInput input;
        checkIndexMember(from, "node", element, "node", skeleton_.nodes.size(), true);
        input.node = static_cast<uint32_t>(from.at("node").index());
        if (skeleton_.nodes[input.node].hasMatrix) {
            refuse(element + " node", at("node", input.node) + " has a matrix, which nothing turns");
        }
        const bool isGiven = member(from, "part") != nullptr;
        const std::string part = stringMember(from, "part", element);
        constexpr TurnPart kParts[] = {TurnPart::rotation, TurnPart::swing, TurnPart::twist};
        const auto* const found =
            std::find_if(std::begin(kParts), std::end(kParts), [&](TurnPart one) { return part == turnPartName(one); });
        if (isGiven && found == std::end(kParts)) {
            refuse(element + " part", quoted(part) + " is not allowed");
        }
        input.part = isGiven ? *found : TurnPart::rotation;
        if (input.part != TurnPart::rotation) {
            input.axis = readAxis(from, element);
        }
        input.weight = numberMember(from, "weight", input.weight, kMinInputWeight, kMaxInputWeight, element);
        return input;
    }

    static glm::vec3 readAxis(const Json& from, const std::string& element) {
        checkNumbers(from, "axis", element, 3);
        const Json* axis = member(from, "axis");
        if (axis == nullptr) {
            refuse(element, "axis is missing");
        }
        const glm::dvec3 given((*axis)[0].number(), (*axis)[1].number(), (*axis)[2].number());
        if (!(glm::length(given) > 1e-6)) {
            refuse(element + " axis", "has no direction");
        }
        return glm::normalize(given);
    }

    void readTargets() {
        for (const Json& target : list("targets", kMaxDriverTargets)) {
            checkIndex(target, place_ + " targets", "morph target", targetCount_);
            const auto index = static_cast<uint32_t>(target.index());
            if (std::count(driver_.targets.begin(), driver_.targets.end(), index) != 0) {
                refuse(place_ + " targets", at("morph target", index) + " is there twice");
            }
            driver_.targets.push_back(index);
        }
    }

    [[nodiscard]] int accessor(const char* key) const {
        checkIndexMember(from_, key, place_, "accessor", document_.model.accessors.size(), true);
        return static_cast<int>(from_.at(key).index());
    }

    void readPoses() {
        const int poses = accessor("poses"), values = accessor("values");
        const size_t rotations = accessorCount(document_, poses), weights = accessorCount(document_, values);
        const size_t inputs = driver_.inputs.size(), count = rotations / inputs;
        if (count == 0 || rotations % inputs != 0 || count > kMaxDriverPoses) {
            refuse(place_ + " poses", counted(rotations, "rotation", "rotations") + " for " +
                                          counted(inputs, "input", "inputs") + ": not of 1 to " +
                                          std::to_string(kMaxDriverPoses) + " poses");
        }
        if (weights != count * driver_.targets.size()) {
            refuse(place_ + " values", std::to_string(weights) + " for " + counted(count, "pose", "poses") + " of " +
                                           counted(driver_.targets.size(), "target", "targets"));
        }
        document_.memory->take(rotations * sizeof(glm::vec4) + weights * sizeof(float) + sizeof(PoseDriver), place_);
        const std::vector<float> read = readFloats(document_, poses, file::kVec4, kFloat, place_ + " poses");
        for (size_t i = 0; i < rotations; ++i) {
            const glm::vec4 q(read[4 * i], read[4 * i + 1], read[4 * i + 2], read[4 * i + 3]);
            const double length = glm::length(glm::dvec4(q));
            if (!(length > kMinTurnLength) || !(length < kMaxTurnLength)) {
                refuse(item(place_ + " poses", i), "not a rotation");
            }
            driver_.poses.push_back(q);
        }
        driver_.values = readFloats(document_, values, file::kScalar, kFloat, place_ + " values");
        for (size_t i = 0; i < weights; ++i) {
            if (const char* fault = faultOfCoordinate(driver_.values[i])) {
                refuse(item(place_ + " values", i), fault);
            }
        }
    }

    void readClamp() {
        checkNumbers(from_, "clamp", place_, 2);
        const Json* clamp = member(from_, "clamp");
        if (clamp == nullptr) {
            return;
        }
        driver_.low = (*clamp)[0].real();
        driver_.high = (*clamp)[1].real();
        for (const float end : {driver_.low, driver_.high}) {
            if (const char* fault = faultOfCoordinate(end)) {
                refuse(place_ + " clamp", fault);
            }
        }
        if (!(driver_.low <= 0.0f && driver_.high >= 0.0f)) {
            refuse(place_ + " clamp", "0, which the rest pose has, does not lie between its numbers");
        }
    }

    const Document& document_;
    const Skeleton& skeleton_;
    size_t targetCount_;
    const Json& from_;
    std::string place_;
    PoseDriver driver_;
};

/// What a driver is called once it is read.
std::string nameOf(const PartCage& part, const PoseDriver& driver) {
    return part.element + " SUPPLE_deformers driver " +
           (driver.name.empty() ? "of " + at("morph target", driver.targets[0]) : cage::quoted(driver.name));
}

/// Refuses a driver that has no solution, and warns of one whose poses are hard to tell apart.
void checkSolution(const PoseDriver& driver, const std::string& place, Warnings& warnings) {
    const Result<SolvedDriver> solved = solveDriver(driver);
    if (!solved) {
        refuse(place, solved.error().message);
    }
    const auto poseName = [](size_t pose) { return pose == 0 ? "the rest pose" : at("pose", pose - 1); };
    if (solved->closestDegrees < kCloseDegrees) {
        warn(warnings, place,
             poseName(solved->closest[0]) + " and " + poseName(solved->closest[1]) + " are " +
                 shortNumber(solved->closestDegrees) +
                 " degrees apart: between and beyond them weights may be far off");
    } else if (solved->condition > kHighCondition) {
        warn(warnings, place,
             "its poses are hard to tell apart (condition " + shortNumber(solved->condition) +
                 "): between and beyond them weights may be far off; a smaller width helps");
    }
    const auto beyond = std::find_if(driver.values.begin(), driver.values.end(),
                                     [&](float value) { return value < driver.low || value > driver.high; });
    if (beyond != driver.values.end()) {
        warn(warnings, place,
             "the value " + shortNumber(static_cast<double>(*beyond)) + " is beyond its clamp, which is what it sets");
    }
}

} // namespace

std::vector<PoseDriver> readDrivers(const Document& document, size_t meshIndex, size_t targetCount,
                                    const Skeleton& skeleton) {
    std::vector<PoseDriver> drivers;
    const std::string mesh = at("mesh", meshIndex) + " " + kDeformers, list = mesh + " drivers";
    document.leniency->leaveOut([&] {
        const Json* const deformers = deformersOf(document.meshes[meshIndex]);
        const Json* const given = deformers != nullptr ? arrayMember(*deformers, "drivers", mesh) : nullptr;
        for (size_t i = 0; given != nullptr && i < given->size(); ++i) {
            const Json& from = (*given)[i];
            document.leniency->leaveOut([&] {
                if (!from.isObject()) {
                    refuse(item(list, i), "not an object");
                }
                std::string name = stringMember(from, "name", item(list, i));
                const std::string place = placeOf(list, i, name);
                document.memory->take(2 * name.size(), place);
                drivers.push_back(DriverReader(document, skeleton, targetCount, from, place).read(std::move(name)));
            });
        }
    });
    return drivers;
}

void checkDrivers(const Document& document, const Character& character, std::span<PartCage> parts, Warnings& warnings) {
    std::vector<bool> swings(character.skeleton.nodes.size(), false);
    for (const Spring& spring : character.springBones.springs) {
        for (size_t j = 0; j < spring.swingingCount(); ++j) {
            swings[spring.joints[j].node] = true;
        }
    }
    const std::vector<size_t> owners = targetOwners(parts, character);
    size_t work = 0;
    for (size_t p = 0; p < parts.size(); ++p) {
        PartCage& part = parts[p];
        if (owners[p] != p) {
            part.drivers = parts[owners[p]].drivers;
            continue;
        }
        std::vector<PoseDriver> kept;
        for (PoseDriver& driver : part.drivers) {
            document.leniency->leaveOut([&] {
                const std::string place = nameOf(part, driver);
                for (const DriverInput& input : driver.inputs) {
                    if (swings[input.node]) {
                        refuse(place, at("node", input.node) + " swings by a spring, after drivers have looked at it");
                    }
                }
                if (work + driverWork(driver) > kMaxDriverWork) {
                    refuse(place, tooMuchDriverWork());
                }
                checkSolution(driver, place, warnings);
                work += driverWork(driver);
                kept.push_back(std::move(driver));
            });
        }
        part.drivers = std::move(kept);
    }
}

} // namespace supple::cage::gltf
