#include "cage/gltf/model.h"

#include "cage/gltf/node_extensions.h"

#include <algorithm>
#include <iterator>

namespace supple::cage::gltf::file {
namespace {

uint64_t unsignedIn(const Json& object, const char* key, uint64_t fallback) {
    const Json* value = member(object, key);
    return value == nullptr ? fallback : value->unsignedInteger();
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

/// Makes structs of what is not broken.
class ModelMaker {
public:
    explicit ModelMaker(const Broken& broken) : broken_(broken) {}

    [[nodiscard]] int index(const Json& object, const char* key) const {
        const Json* value = sound(object, key);
        return value == nullptr ? -1 : static_cast<int>(value->index());
    }
    [[nodiscard]] std::vector<int> indices(const Json& object, const char* key) const {
        std::vector<int> indices;
        if (const Json* values = sound(object, key)) {
            indices.reserve(values->size());
            for (const Json& value : *values) {
                if (!broken_.contains(value)) {
                    indices.push_back(static_cast<int>(value.index()));
                }
            }
        }
        return indices;
    }

    [[nodiscard]] BufferView bufferView(const Json& from) const {
        if (broken_.contains(from)) {
            return {.broken = true};
        }
        return {.buffer = from.at("buffer").index(),
                .byteOffset = unsignedIn(from, "byteOffset", 0),
                .byteLength = unsignedIn(from, "byteLength", 0),
                .byteStride = unsignedIn(from, "byteStride", 0)};
    }

    [[nodiscard]] Accessor accessor(const Json& from) const {
        if (broken_.contains(from)) {
            return {.broken = true};
        }
        Accessor accessor;
        accessor.bufferView = index(from, "bufferView");
        accessor.byteOffset = unsignedIn(from, "byteOffset", 0);
        accessor.componentType = static_cast<int>(unsignedIn(from, "componentType", 0));
        accessor.normalized = from.at("normalized").boolean();
        accessor.count = unsignedIn(from, "count", 0);
        const auto type = std::find(std::begin(kTypeNames), std::end(kTypeNames), from.at("type").text());
        accessor.type = static_cast<int>(type - std::begin(kTypeNames));
        if (const Json* sparse = sound(from, "sparse")) {
            accessor.sparseCount = unsignedIn(*sparse, "count", 0);
            accessor.sparseIndices = sparsePart(sparse->at("indices"));
            accessor.sparseValues = sparsePart(sparse->at("values"));
        }
        return accessor;
    }

    [[nodiscard]] Mesh mesh(const Json& from) const {
        if (broken_.contains(from)) {
            return {from.at("name").string(), {}, {}};
        }
        return {from.at("name").string(),
                toTable<Primitive>(from, "primitives", [this](const Json& each) { return primitive(each); }),
                numbers(from, "weights")};
    }

    [[nodiscard]] Node node(const Json& from) const {
        Node node;
        node.name = from.at("name").string();
        node.mesh = index(from, "mesh");
        node.skin = index(from, "skin");
        node.hidden = saysHidden(from);
        node.children = indices(from, "children");
        node.translation = numbers(from, "translation");
        node.rotation = numbers(from, "rotation");
        node.scale = numbers(from, "scale");
        node.matrix = numbers(from, "matrix");
        node.weights = numbers(from, "weights");
        return node;
    }

    [[nodiscard]] Skin skin(const Json& from) const {
        return broken_.contains(from) ? Skin{} : Skin{indices(from, "joints"), index(from, "inverseBindMatrices")};
    }

    [[nodiscard]] Animation animation(const Json& from) const {
        if (broken_.contains(from)) {
            return {from.at("name").string(), {}, {}, {}};
        }
        return {from.at("name").string(),
                toTable<AnimationSampler>(from, "samplers", [this](const Json& each) { return sampler(each); }),
                toTable<AnimationChannel>(from, "channels", [this](const Json& each) { return channel(each); }),
                from.at("extras")};
    }

private:
    /// Null where the member is absent or broken.
    [[nodiscard]] const Json* sound(const Json& object, const char* key) const {
        const Json* value = member(object, key);
        return value == nullptr || broken_.contains(*value) ? nullptr : value;
    }
    [[nodiscard]] std::vector<double> numbers(const Json& object, const char* key) const {
        std::vector<double> numbers;
        if (const Json* values = sound(object, key)) {
            numbers.reserve(values->size());
            std::transform(values->begin(), values->end(), std::back_inserter(numbers),
                           [](const Json& value) { return value.number(); });
        }
        return numbers;
    }
    [[nodiscard]] SparsePart sparsePart(const Json& from) const {
        return {index(from, "bufferView"), unsignedIn(from, "byteOffset", 0),
                static_cast<int>(unsignedIn(from, "componentType", 0))};
    }
    [[nodiscard]] Attributes attributes(const Json& object) const {
        Attributes attributes;
        for (const JsonMember& attribute : object.members()) {
            if (!broken_.contains(attribute.value)) {
                attributes.emplace_hint(attributes.end(), attribute.name, static_cast<int>(attribute.value.index()));
            }
        }
        return attributes;
    }
    [[nodiscard]] Primitive primitive(const Json& from) const {
        if (broken_.contains(from)) {
            return {.broken = true};
        }
        Primitive primitive;
        primitive.attributes = attributes(from.at("attributes"));
        primitive.targets =
            toTable<Attributes>(from, "targets", [this](const Json& target) { return attributes(target); });
        primitive.indices = index(from, "indices");
        primitive.material = index(from, "material");
        primitive.mode = static_cast<int>(unsignedIn(from, "mode", kTriangles));
        primitive.json = from;
        return primitive;
    }
    [[nodiscard]] AnimationSampler sampler(const Json& from) const {
        if (broken_.contains(from)) {
            return {.broken = true};
        }
        return {.input = index(from, "input"),
                .output = index(from, "output"),
                .interpolation = from.at("interpolation").string()};
    }
    [[nodiscard]] AnimationChannel channel(const Json& from) const {
        if (broken_.contains(from)) {
            return {.broken = true};
        }
        const int sampler = index(from, "sampler");
        const Json& target = from.at("target");
        const std::string path = target.at("path").string();
        if (path == "pointer" || member(target, "node") == nullptr) {
            const Json& extension = target.at("extensions").at("KHR_animation_pointer");
            return {.sampler = sampler, .node = 0, .path = "pointer", .pointer = extension.at("pointer").string()};
        }
        return {.sampler = sampler, .node = index(target, "node"), .path = path, .pointer = {}};
    }

    const Broken& broken_;
};

} // namespace

Model toModel(const Json& root, const std::vector<int>& decodedInto, const Broken& broken) {
    const ModelMaker make(broken);
    Model model;
    model.copyright = root.at("asset").at("copyright").string();
    model.extensionsUsed = stringsIn(root, "extensionsUsed");
    model.extensionsRequired = stringsIn(root, "extensionsRequired");
    model.bufferViews =
        toTable<BufferView>(root, "bufferViews", [&](const Json& each) { return make.bufferView(each); });
    for (size_t i = 0; i < model.bufferViews.size(); ++i) {
        if (decodedInto[i] >= 0) {
            model.bufferViews[i].buffer = static_cast<size_t>(decodedInto[i]);
            model.bufferViews[i].byteOffset = 0;
        }
    }
    model.accessors = toTable<Accessor>(root, "accessors", [&](const Json& each) { return make.accessor(each); });
    model.meshes = toTable<Mesh>(root, "meshes", [&](const Json& each) { return make.mesh(each); });
    model.nodes = toTable<Node>(root, "nodes", [&](const Json& each) { return make.node(each); });
    model.skins = toTable<Skin>(root, "skins", [&](const Json& each) { return make.skin(each); });
    for (Node& node : model.nodes) {
        if (node.skin >= 0 && model.skins[static_cast<size_t>(node.skin)].joints.empty()) {
            node.skin = -1;
        }
    }
    model.animations = toTable<Animation>(root, "animations", [&](const Json& each) { return make.animation(each); });
    model.scenes = toTable<Scene>(root, "scenes", [&](const Json& each) { return Scene{make.indices(each, "nodes")}; });
    model.defaultScene = make.index(root, "scene");
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
