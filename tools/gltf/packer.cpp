#include "tools/gltf/packer.h"

#include "cage/refusal.h"

#include <algorithm>
#include <limits>
#include <string_view>

namespace supple::cage::gltf {
namespace {

constexpr int kFloatComponent = 5126;
constexpr uint32_t kJsonChunk = 0x4E4F534Au;
constexpr uint32_t kBinaryChunk = 0x004E4942u;

size_t widthOf(std::string_view type) {
    return type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 16;
}

void appendInteger(std::vector<std::byte>& bytes, uint32_t value, size_t size) {
    for (size_t i = 0; i < size; ++i) {
        bytes.push_back(static_cast<std::byte>(value >> (8 * i)));
    }
}

void padTo4(std::vector<std::byte>& bytes, std::byte with = std::byte{0}) {
    bytes.resize((bytes.size() + 3) / 4 * 4, with);
}

size_t sizeOf(Packer::Component component) {
    return component == Packer::Component::u8 ? 1 : component == Packer::Component::u16 ? 2 : 4;
}

std::vector<std::byte> packed(std::span<const uint32_t> values, Packer::Component component) {
    std::vector<std::byte> bytes;
    bytes.reserve(values.size() * sizeOf(component));
    for (const uint32_t value : values) {
        appendInteger(bytes, value, sizeOf(component));
    }
    return bytes;
}

/// Exact: every float is a double.
void setBounds(json& accessor, std::span<const float> values, size_t width, bool withZero) {
    std::vector<double> low(width, withZero ? 0.0 : std::numeric_limits<double>::infinity());
    std::vector<double> high(width, withZero ? 0.0 : -std::numeric_limits<double>::infinity());
    for (size_t i = 0; i < values.size(); ++i) {
        low[i % width] = std::min<double>(low[i % width], values[i]);
        high[i % width] = std::max<double>(high[i % width], values[i]);
    }
    accessor["min"] = low;
    accessor["max"] = high;
}

} // namespace

size_t Packer::addBytes(std::span<const std::byte> bytes, Target target) {
    json view = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}};
    if (target != Target::none) {
        view["target"] = static_cast<int>(target);
    }
    binary_.insert(binary_.end(), bytes.begin(), bytes.end());
    padTo4(binary_);
    views_.push_back(std::move(view));
    return views_.size() - 1;
}

size_t Packer::addAccessor(json accessor) {
    accessors_.push_back(std::move(accessor));
    return accessors_.size() - 1;
}

size_t Packer::addFloats(const char* type, std::span<const float> values, Target target, bool bounds) {
    json accessor = {{"bufferView", addBytes(std::as_bytes(values), target)},
                     {"componentType", kFloatComponent},
                     {"count", values.size() / widthOf(type)},
                     {"type", type}};
    if (bounds) {
        setBounds(accessor, values, widthOf(type), false);
    }
    return addAccessor(std::move(accessor));
}

size_t Packer::addIntegers(const char* type, std::span<const uint32_t> values, Component component, Target target,
                           bool normalized) {
    json accessor = {{"bufferView", addBytes(packed(values, component), target)},
                     {"componentType", static_cast<int>(component)},
                     {"count", values.size() / widthOf(type)},
                     {"type", type}};
    if (normalized) {
        accessor["normalized"] = true;
    }
    return addAccessor(std::move(accessor));
}

size_t Packer::addSparseFloats(const char* type, size_t count, std::span<const uint32_t> indices,
                               std::span<const float> values) {
    json accessor = {{"componentType", kFloatComponent}, {"count", count}, {"type", type}};
    if (!indices.empty()) {
        const Component component = indexComponent(indices.back());
        accessor["sparse"] = {
            {"count", indices.size()},
            {"indices",
             {{"bufferView", addBytes(packed(indices, component))}, {"componentType", static_cast<int>(component)}}},
            {"values", {{"bufferView", addBytes(std::as_bytes(values))}}}};
    }
    setBounds(accessor, values, widthOf(type), indices.size() < count);
    return addAccessor(std::move(accessor));
}

std::vector<std::byte> Packer::finish(json root) && {
    root["accessors"] = std::move(accessors_);
    root["bufferViews"] = std::move(views_);
    root["buffers"] = json::array({json::object({{"byteLength", binary_.size()}})});
    // Names come from files as they are: what is not UTF-8 is replaced.
    std::string text = root.dump(-1, ' ', false, json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');

    const uint64_t total = 12 + 8 + text.size() + 8 + binary_.size();
    if (total > std::numeric_limits<uint32_t>::max()) {
        refuse("GLB", "larger than 4 GiB", ErrorCode::limit);
    }
    std::vector<std::byte> glb;
    glb.reserve(total);
    const auto word = [&](uint64_t value) { appendInteger(glb, static_cast<uint32_t>(value), 4); };
    word(0x46546C67u); // "glTF"
    word(2);
    word(total);
    word(text.size());
    word(kJsonChunk);
    const auto letters = std::as_bytes(std::span(text));
    glb.insert(glb.end(), letters.begin(), letters.end());
    word(binary_.size());
    word(kBinaryChunk);
    glb.insert(glb.end(), binary_.begin(), binary_.end());
    return glb;
}

} // namespace supple::cage::gltf
