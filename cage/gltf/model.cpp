#include "cage/gltf/model.h"

#include <algorithm>
#include <iterator>

namespace supple::cage::gltf::file {
namespace {

int indexIn(const Json& object, const char* key) {
    const Json* value = member(object, key);
    return value == nullptr ? -1 : static_cast<int>(value->index());
}

uint64_t unsignedIn(const Json& object, const char* key, uint64_t fallback) {
    const Json* value = member(object, key);
    return value == nullptr ? fallback : value->unsignedInteger();
}

std::vector<int> indicesIn(const Json& object, const char* key) {
    std::vector<int> indices;
    if (const Json* values = member(object, key)) {
        indices.reserve(values->size());
        std::transform(values->begin(), values->end(), std::back_inserter(indices),
                       [](const Json& value) { return static_cast<int>(value.index()); });
    }
    return indices;
}

std::vector<double> numbersIn(const Json& object, const char* key) {
    std::vector<double> numbers;
    if (const Json* values = member(object, key)) {
        numbers.reserve(values->size());
        std::transform(values->begin(), values->end(), std::back_inserter(numbers),
                       [](const Json& value) { return value.number(); });
    }
    return numbers;
}

std::set<std::string, std::less<>> stringsIn(const Json& object, const char* key) {
    std::set<std::string, std::less<>> strings;
    if (const Json* values = member(object, key)) {
        for (const Json& value : *values) {
            strings.insert(value.string());
        }
    }
    return strings;
}

Attributes toAttributes(const Json& object) {
    Attributes attributes;
    for (const JsonMember& attribute : object.members()) {
        attributes.emplace_hint(attributes.end(), attribute.name, static_cast<int>(attribute.value.index()));
    }
    return attributes;
}

/// One struct for each of a table.
template <class T, class Make>
std::vector<T> toTable(const Json& elements, Make&& make) {
    std::vector<T> made;
    made.reserve(elements.size());
    for (const Json& element : elements) {
        made.push_back(make(element));
    }
    return made;
}

template <class T, class Make>
std::vector<T> toTable(const Json& object, const char* key, Make&& make) {
    const Json* elements = member(object, key);
    return elements == nullptr ? std::vector<T>() : toTable<T>(*elements, make);
}

SparsePart toSparsePart(const Json& from) {
    return {indexIn(from, "bufferView"), unsignedIn(from, "byteOffset", 0),
            static_cast<int>(unsignedIn(from, "componentType", 0))};
}

Accessor toAccessor(const Json& from) {
    Accessor accessor;
    accessor.bufferView = indexIn(from, "bufferView");
    accessor.byteOffset = unsignedIn(from, "byteOffset", 0);
    accessor.componentType = static_cast<int>(unsignedIn(from, "componentType", 0));
    accessor.normalized = from.at("normalized").boolean();
    accessor.count = unsignedIn(from, "count", 0);
    const auto type = std::find(std::begin(kTypeNames), std::end(kTypeNames), from.at("type").text());
    accessor.type = static_cast<int>(type - std::begin(kTypeNames));
    if (const Json* sparse = member(from, "sparse")) {
        accessor.sparseCount = unsignedIn(*sparse, "count", 0);
        accessor.sparseIndices = toSparsePart(sparse->at("indices"));
        accessor.sparseValues = toSparsePart(sparse->at("values"));
    }
    return accessor;
}

Primitive toPrimitive(const Json& from) {
    Primitive primitive;
    primitive.attributes = toAttributes(from.at("attributes"));
    primitive.targets = toTable<Attributes>(from, "targets", toAttributes);
    primitive.indices = indexIn(from, "indices");
    primitive.material = indexIn(from, "material");
    primitive.mode = static_cast<int>(unsignedIn(from, "mode", kTriangles));
    primitive.json = from;
    return primitive;
}

Mesh toMesh(const Json& from) {
    return {from.at("name").string(), toTable<Primitive>(from, "primitives", toPrimitive), numbersIn(from, "weights")};
}

Node toNode(const Json& from) {
    Node node;
    node.name = from.at("name").string();
    node.mesh = indexIn(from, "mesh");
    node.skin = indexIn(from, "skin");
    node.children = indicesIn(from, "children");
    node.translation = numbersIn(from, "translation");
    node.rotation = numbersIn(from, "rotation");
    node.scale = numbersIn(from, "scale");
    node.matrix = numbersIn(from, "matrix");
    node.weights = numbersIn(from, "weights");
    return node;
}

AnimationChannel toChannel(const Json& from) {
    const Json* target = member(from, "target");
    if (target == nullptr || member(*target, "node") == nullptr) {
        return {indexIn(from, "sampler"), 0, "pointer"};
    }
    return {indexIn(from, "sampler"), indexIn(*target, "node"), target->at("path").string()};
}

Animation toAnimation(const Json& from) {
    return {from.at("name").string(),
            toTable<AnimationSampler>(from, "samplers",
                                      [](const Json& sampler) {
                                          return AnimationSampler{indexIn(sampler, "input"), indexIn(sampler, "output"),
                                                                  sampler.at("interpolation").string()};
                                      }),
            toTable<AnimationChannel>(from, "channels", toChannel), from.at("extras")};
}

std::vector<BufferView> toBufferViews(const Json& root, const std::vector<int>& decodedInto) {
    std::vector<BufferView> views = toTable<BufferView>(root, "bufferViews", [](const Json& from) {
        return BufferView{from.at("buffer").index(), unsignedIn(from, "byteOffset", 0),
                          unsignedIn(from, "byteLength", 0), unsignedIn(from, "byteStride", 0)};
    });
    for (size_t i = 0; i < views.size(); ++i) {
        if (decodedInto[i] >= 0) {
            views[i].buffer = static_cast<size_t>(decodedInto[i]);
            views[i].byteOffset = 0;
        }
    }
    return views;
}

} // namespace

Model toModel(const Json& root, const std::vector<int>& decodedInto) {
    Model model;
    model.copyright = root.at("asset").at("copyright").string();
    model.extensionsUsed = stringsIn(root, "extensionsUsed");
    model.extensionsRequired = stringsIn(root, "extensionsRequired");
    model.bufferViews = toBufferViews(root, decodedInto);
    model.accessors = toTable<Accessor>(root, "accessors", toAccessor);
    model.meshes = toTable<Mesh>(root, "meshes", toMesh);
    model.nodes = toTable<Node>(root, "nodes", toNode);
    model.skins = toTable<Skin>(root, "skins", [](const Json& from) {
        return Skin{indicesIn(from, "joints"), indexIn(from, "inverseBindMatrices")};
    });
    model.animations = toTable<Animation>(root, "animations", toAnimation);
    model.scenes = toTable<Scene>(root, "scenes", [](const Json& from) { return Scene{indicesIn(from, "nodes")}; });
    model.defaultScene = indexIn(root, "scene");
    return model;
}

size_t componentSize(int componentType) {
    switch (componentType) {
    case kByte:
    case kUnsignedByte:
        return 1;
    case kShort:
    case kUnsignedShort:
        return 2;
    default:
        return 4;
    }
}

size_t componentsOf(int type) {
    static constexpr size_t kComponents[] = {1, 2, 3, 4, 4, 9, 16};
    return kComponents[type];
}

} // namespace supple::cage::gltf::file
