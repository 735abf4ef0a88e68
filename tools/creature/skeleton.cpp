#include "skeleton.h"

#include <cstdio>
#include <cstdlib>

namespace supple::creature {

int Skeleton::index(const std::string& name) const {
    for (size_t i = 0; i < joints.size(); ++i) {
        if (joints[i].name == name) {
            return static_cast<int>(i);
        }
    }
    std::fprintf(stderr, "supple_creature: no joint is called %s\n", name.c_str());
    std::exit(1);
}

Links Skeleton::links(const std::string& name) const {
    Links links;
    Vec3 end{0};
    for (const Joint& joint : joints) {
        if (joint.name == name + std::to_string(links.joints.size() + 1)) {
            links.joints.push_back(joint.name);
            links.places.push_back(joint.rest);
            end = joint.end;
        }
    }
    links.places.push_back(end);
    return links;
}

Vec3 Skeleton::offset(int joint) const {
    const Joint& it = joints[static_cast<size_t>(joint)];
    return it.parent < 0 ? it.rest : it.rest - joints[static_cast<size_t>(it.parent)].rest;
}

} // namespace supple::creature
