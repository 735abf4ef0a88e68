#include "cage/gltf/pointer.h"

#include "cage/message.h"
#include "cage/refusal.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace supple::cage::gltf {
namespace {

bool isArrayIndex(std::string_view token) {
    return !token.empty() && std::all_of(token.begin(), token.end(), [](char c) { return c >= '0' && c <= '9'; });
}

} // namespace

void resolvePointer(size_t nodeCount, const std::string& element, file::AnimationChannel& channel) {
    constexpr std::string_view kNodes = "/nodes/";
    constexpr std::array<std::string_view, 4> kPaths{"translation", "rotation", "scale", "weights"};
    std::string_view rest = channel.pointer;
    if (!rest.starts_with(kNodes)) {
        return;
    }
    rest.remove_prefix(kNodes.size());
    const size_t slash = rest.find('/');
    if (slash == std::string_view::npos || !isArrayIndex(rest.substr(0, slash)) ||
        std::find(kPaths.begin(), kPaths.end(), rest.substr(slash + 1)) == kPaths.end()) {
        return;
    }
    size_t node = 0;
    const auto end = std::from_chars(rest.data(), rest.data() + slash, node);
    if (end.ec != std::errc() || node >= nodeCount) {
        refuse(element + " pointer", "node " + std::string(rest.substr(0, std::min<size_t>(slash, 20))) +
                                         " is out of range: the file has " + std::to_string(nodeCount));
    }
    channel.node = static_cast<int>(node);
    channel.path = rest.substr(slash + 1);
}

std::string kindOfPointer(std::string_view pointer) {
    std::string kind;
    for (size_t begin = 0; begin <= pointer.size();) {
        const size_t end = std::min(pointer.find('/', begin), pointer.size());
        const std::string_view token = pointer.substr(begin, end - begin);
        kind += begin == 0 ? "" : "/";
        kind += isArrayIndex(token) ? "*" : token;
        begin = end + 1;
    }
    return kind;
}

} // namespace supple::cage::gltf
