#include "runtime/points/uv_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace supple::runtime {

UvTree::UvTree(const cage::Cage& cage, std::span<const glm::vec2> uvs, std::span<const PointDomain> domains)
    : order_(domains.size()) {
    domains_.reserve(domains.size());
    faces_.reserve(domains.size());
    std::vector<UvBox> boxes;
    boxes.reserve(domains.size());
    glm::dvec2 middle(0.0);
    for (const PointDomain& domain : domains) {
        const uint32_t sides = cage.sides(domain.face);
        if (sides > 4 && domain.side == 0) { // the other sides follow
            middle = glm::dvec2(0.0);
            for (uint32_t k = 0; k < sides; ++k) {
                middle += glm::dvec2(uvs[cage.faceStarts[domain.face] + k]) / static_cast<double>(sides);
            }
        }
        domains_.emplace_back(cage, uvs, domain, middle);
        faces_.push_back(domain.face);
        boxes.push_back(domains_.back().box());
    }
    std::iota(order_.begin(), order_.end(), 0u);
    if (!domains.empty()) {
        (void)split(0, static_cast<uint32_t>(domains.size()), boxes);
    }
}

uint32_t UvTree::split(uint32_t begin, uint32_t end, std::span<const UvBox> boxes) {
    const auto number = static_cast<uint32_t>(nodes_.size());
    Node node{boxes[order_[begin]], order_[begin], begin, end, 0};
    for (uint32_t k = begin; k < end; ++k) {
        node.box.add(boxes[order_[k]]);
        node.first = std::min(node.first, order_[k]);
    }
    nodes_.push_back(node);
    if (end - begin > kLeaf) {
        const glm::dvec2 size = node.box.high - node.box.low;
        const int axis = size.x >= size.y ? 0 : 1;
        const uint32_t middle = begin + (end - begin) / 2;
        const auto at = [&](uint32_t k) { return order_.begin() + static_cast<ptrdiff_t>(k); };
        std::nth_element(at(begin), at(middle), at(end), [&](uint32_t x, uint32_t y) {
            return boxes[x].low[axis] + boxes[x].high[axis] < boxes[y].low[axis] + boxes[y].high[axis];
        });
        (void)split(begin, middle, boxes);
        const uint32_t second = split(middle, end, boxes);
        nodes_[number].second = second;
    }
    return number;
}

std::vector<UvTree::Found> UvTree::find(const glm::dvec2& uv, size_t most) const {
    std::vector<Found> found;
    if (!nodes_.empty()) {
        search(0, uv, most, found);
    }
    return found;
}

void UvTree::search(uint32_t number, const glm::dvec2& uv, size_t most, std::vector<Found>& found) const {
    const Node& node = nodes_[number];
    if (!node.box.covers(uv) || (found.size() == most && found.back().domain < node.first)) {
        return;
    }
    if (node.second != 0) {
        search(number + 1, uv, most, found);
        search(node.second, uv, most, found);
        return;
    }
    for (uint32_t k = node.begin; k < node.end; ++k) {
        const uint32_t domain = order_[k];
        if (found.size() == most && found.back().domain < domain) {
            continue;
        }
        if (const std::optional<glm::dvec2> at = domains_[domain].find(uv)) {
            take({domain, *at}, most, found);
        }
    }
}

void UvTree::take(const Found& own, size_t most, std::vector<Found>& found) const {
    const auto isOfItsFace = [&](const Found& other) { return faces_[other.domain] == faces_[own.domain]; };
    const auto next = std::lower_bound(found.begin(), found.end(), own,
                                       [](const Found& a, const Found& b) { return a.domain < b.domain; });
    // A face's domains follow each other, so one of the same face stands beside.
    if (next != found.begin() && isOfItsFace(*(next - 1))) {
        return;
    }
    if (next != found.end() && isOfItsFace(*next)) {
        *next = own;
        return;
    }
    found.insert(next, own);
    found.resize(std::min(found.size(), most));
}

} // namespace supple::runtime
