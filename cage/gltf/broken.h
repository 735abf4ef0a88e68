// What of a file's JSON cannot be used, and counts as if it were not there. Private to cage/gltf/.
#pragma once

#include "cage/gltf/json_tree.h"

#include <set>

namespace supple::cage::gltf {

/// Elements and members, by where they stand in the tree.
class Broken {
public:
    void add(const Json& value) { values_.insert(&value); }
    [[nodiscard]] bool contains(const Json& value) const { return values_.count(&value) != 0; }

private:
    std::set<const Json*> values_;
};

} // namespace supple::cage::gltf
