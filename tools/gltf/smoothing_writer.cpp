#include "tools/gltf/smoothing_writer.h"

namespace supple::cage::gltf {

bool saysSmoothing(const Character& part) {
    return part.parts[0].smoothing || !part.weights.mushMask.empty();
}

json writeSmoothing(const Character& part) {
    json written = json::object();
    if (const auto& smoothing = part.parts[0].smoothing) {
        written = {{"lambda", smoothing->lambda}, {"iterations", smoothing->iterations}};
    }
    if (!part.weights.mushMask.empty()) {
        written["mask"] = kMushMaskAttribute;
    }
    return written;
}

} // namespace supple::cage::gltf
