#include "tools/gltf/driver_writer.h"

namespace supple::cage::gltf {

namespace {

json writeInput(const DriverInput& input) {
    json written = {{"node", input.node}, {"part", turnPartName(input.part)}};
    if (input.part != TurnPart::rotation) {
        written["axis"] = numbers(input.axis);
    }
    if (input.weight != 1.0f) {
        written["weight"] = input.weight;
    }
    return written;
}

} // namespace

json writeDrivers(std::span<const PoseDriver> drivers, Packer& packer) {
    json list = json::array();
    for (const PoseDriver& driver : drivers) {
        json written = json::object();
        if (!driver.name.empty()) {
            written["name"] = driver.name;
        }
        for (const DriverInput& input : driver.inputs) {
            written["inputs"].push_back(writeInput(input));
        }
        const std::span<const float> poses(&driver.poses[0].x, 4 * driver.poses.size());
        written["poses"] = packer.addFloats("VEC4", poses, Packer::Target::none);
        written["values"] = packer.addFloats("SCALAR", driver.values, Packer::Target::none);
        written["targets"] = driver.targets;
        written["width"] = driver.width;
        written["clamp"] = {driver.low, driver.high};
        list.push_back(std::move(written));
    }
    return list;
}

} // namespace supple::cage::gltf
