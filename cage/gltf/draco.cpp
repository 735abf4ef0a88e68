#include "cage/gltf/draco.h"

#include "cage/gltf/draco_decoder.h"
#include "cage/gltf/triangles.h"
#include "cage/message.h"
#include "cage/refusal.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace supple::cage::gltf {
namespace {

using file::Accessor;
using file::Primitive;

/// What a compressed byte counts as among the bytes of a file (MemoryBudget). A vertex of a dense, even mesh is encoded
/// in little more than a byte, with all that it has and its two triangles; read, they take 1.4 KB.
constexpr uint64_t kBytesPerByte = 24;

class DracoReader {
public:
    explicit DracoReader(Document& document)
        : document_(document), model_(document.model), viewCount_(model_.bufferViews.size()) {}

    void read() {
        for (size_t m = 0; m < model_.meshes.size(); ++m) {
            for (size_t k = 0; k < model_.meshes[m].primitives.size(); ++k) {
                Primitive& primitive = model_.meshes[m].primitives[k];
                const std::string element = at("mesh", m) + " " + at("primitive", k) + " " + kDraco;
                if (!needsDecoding(primitive)) {
                    continue;
                }
                if (!canDecodeDraco()) {
                    document_.leniency->gather([&] {
                        refuse(element,
                               "this build of Supple reads no Draco-compressed files (SUPPLE_WITH_DRACO is off)");
                    });
                    continue;
                }
                primitive.broken = !document_.leniency->leaveOut([&] { decode(primitive, element); });
            }
        }
        document_.leniency->raise();
        if (count_ > 0) {
            warn(document_.warnings, kDraco,
                 counted(count_, "primitive is", "primitives are") +
                     " compressed: positions are rounded, and vertices and triangles are usually reordered, so that "
                     "polygons that are read from that order are lost");
        }
    }

private:
    /// What was decoded, as indices of new accessors. Primitives may have all of it in common.
    struct Decoded {
        int indices = -1;
        bool isReordered = false;
        std::vector<std::pair<std::string, int>> attributes;
    };
    /// The bufferView, and per attribute its name, Draco's number and the accessor that says its form.
    using Key = std::pair<size_t, std::vector<std::tuple<std::string, uint32_t, int>>>;

    [[nodiscard]] bool hasBytes(int accessor) const {
        const Accessor& of = model_.accessors[static_cast<size_t>(accessor)];
        return of.broken || of.bufferView >= 0 || of.sparseCount > 0;
    }

    /// Files whose readers need not know the extension have the bytes as well. These are exact, so they are taken.
    [[nodiscard]] bool needsDecoding(const Primitive& primitive) const {
        if (primitive.broken || !hasTriangles(primitive.mode) || !hasExtension(primitive.json, kDraco)) {
            return false;
        }
        const auto position = primitive.attributes.find("POSITION");
        const bool hasPlace = position == primitive.attributes.end() || hasBytes(position->second);
        return !hasPlace || (primitive.indices >= 0 && !hasBytes(primitive.indices));
    }

    [[nodiscard]] std::span<const std::byte> bytesOf(size_t view, const std::string& element) const {
        const file::BufferView& from = model_.bufferViews[view];
        if (from.broken) {
            refuse(element, at("bufferView", view) + " cannot be read");
        }
        return document_.buffers[from.buffer].subspan(static_cast<size_t>(from.byteOffset),
                                                      static_cast<size_t>(from.byteLength));
    }

    Key keyOf(const Primitive& primitive, const std::string& element) const {
        const Json* extension = &primitive.json.at("extensions").at(kDraco);
        if (!extension->isObject()) {
            refuse(element, "not an object");
        }
        checkIndexMember(*extension, "bufferView", element, "bufferView", viewCount_, true);
        const Json* attributes = objectMember(*extension, "attributes", element);
        if (attributes == nullptr) {
            refuse(element, "no attributes");
        }
        const Json* position = member(*attributes, "POSITION");
        const auto ownPosition = primitive.attributes.find("POSITION");
        if (position == nullptr && ownPosition != primitive.attributes.end() && !hasBytes(ownPosition->second)) {
            refuse(element, "no POSITION among its attributes");
        }
        Key key{extension->at("bufferView").index(), {}};
        for (const auto& [name, value] : attributes->members()) {
            const uint64_t id = toUnsigned(value, within(element + " attributes", std::string(name)));
            const auto own = primitive.attributes.find(name);
            // One that the primitive does not have is not read, whatever it is. One that has bytes as well is decoded
            // with the others: the encoder may have changed the order of vertices.
            if (own != primitive.attributes.end() && !model_.accessors[static_cast<size_t>(own->second)].broken) {
                key.second.emplace_back(name, static_cast<uint32_t>(id), own->second);
            }
        }
        return key;
    }

    void decode(Primitive& primitive, const std::string& element) {
        const Key key = keyOf(primitive, element);
        auto known = decoded_.find(key);
        if (known == decoded_.end()) {
            if (failed_.contains(key)) { // decoding it again would take as long
                refuse(element, "cannot be decoded, as said of another primitive");
            }
            failed_.insert(key);
            known = decoded_.emplace(key, decodeNew(key, primitive, element)).first;
            failed_.erase(key);
        }
        ++count_;
        if (known->second.isReordered) {
            warnOfOthers(primitive, key, element);
        }
        primitive.indices = known->second.indices;
        primitive.mode = file::kTriangles; // Draco has triangles alone, also of strips
        primitive.isReordered = known->second.isReordered;
        for (const auto& [name, accessor] : known->second.attributes) {
            primitive.attributes[name] = accessor;
        }
    }

    Decoded decodeNew(const Key& key, const Primitive& primitive, const std::string& element) {
        const std::span<const std::byte> bytes = bytesOf(key.first, element);
        if (counted_.insert(key.first).second) {
            document_.memory->addFile((kBytesPerByte - 1) * bytes.size());
        }
        std::vector<DracoAttribute> wanted;
        for (const auto& [name, id, accessor] : key.second) {
            const Accessor& of = model_.accessors[static_cast<size_t>(accessor)];
            wanted.push_back({name, id, of.componentType, file::componentsOf(of.type)});
        }
        DracoMesh mesh = decodeDracoMesh(bytes, wanted, *document_.memory, element);
        compareCounts(mesh, key, primitive, element);

        Decoded decoded;
        decoded.isReordered = !mesh.keepsOrder;
        std::vector<std::byte> indices(mesh.indices.size() * sizeof(uint32_t));
        std::memcpy(indices.data(), mesh.indices.data(), indices.size());
        Accessor of;
        of.componentType = file::kUnsignedInt;
        of.count = mesh.indices.size();
        decoded.indices = add(of, std::move(indices));
        for (size_t i = 0; i < wanted.size(); ++i) {
            of = model_.accessors[static_cast<size_t>(std::get<2>(key.second[i]))];
            of.count = mesh.vertexCount;
            decoded.attributes.emplace_back(wanted[i].name, add(of, std::move(mesh.attributes[i])));
        }
        return decoded;
    }

    /// What is not compressed must lie in the new order of the vertices. Whether it does, nothing in a file tells.
    void warnOfOthers(const Primitive& primitive, const Key& key, const std::string& element) {
        std::string others;
        const auto add = [&](const std::string& name) { others += (others.empty() ? "" : ", ") + name; };
        for (const auto& own : primitive.attributes) {
            const bool isDecoded = std::any_of(key.second.begin(), key.second.end(),
                                               [&](const auto& one) { return std::get<0>(one) == own.first; });
            if (!isDecoded && !model_.accessors[static_cast<size_t>(own.second)].broken) {
                add(own.first);
            }
        }
        if (!primitive.targets.empty()) {
            add("morph targets");
        }
        if (!others.empty()) {
            warn(document_.warnings, element,
                 "vertices are in another order than before they were compressed; what is not compressed must have "
                 "that order, and is taken as it stands: " +
                     others);
        }
    }

    /// What was encoded is right whatever accessors say of it.
    void compareCounts(const DracoMesh& mesh, const Key& key, const Primitive& primitive, const std::string& element) {
        const auto compare = [&](const std::string& name, int accessor, uint64_t count) {
            const uint64_t said = model_.accessors[static_cast<size_t>(accessor)].count;
            if (said != count) {
                document_.leniency->mend(element + " " + name,
                                         counted(count, "element is", "elements are") +
                                             " compressed, its accessor has " + std::to_string(said),
                                         "the compressed are taken");
            }
        };
        for (const auto& [name, id, accessor] : key.second) {
            compare(name, accessor, mesh.vertexCount);
        }
        if (primitive.indices >= 0 && primitive.mode == file::kTriangles) {
            compare("indices", primitive.indices, mesh.indices.size());
        }
    }

    /// A new accessor over a bufferView and a buffer of its own.
    int add(Accessor accessor, std::vector<std::byte> bytes) {
        accessor.bufferView = static_cast<int>(model_.bufferViews.size());
        accessor.byteOffset = 0;
        model_.bufferViews.push_back({.buffer = document_.buffers.size(), .byteLength = bytes.size()});
        document_.owned.emplace_back(std::move(bytes));
        document_.buffers.emplace_back(document_.owned.back());
        model_.accessors.push_back(accessor);
        return static_cast<int>(model_.accessors.size()) - 1;
    }

    Document& document_;
    file::Model& model_;
    const size_t viewCount_; ///< of the file's own
    std::map<Key, Decoded> decoded_;
    std::set<Key> failed_;
    std::set<size_t> counted_; ///< bufferViews that count as more bytes of the file
    size_t count_ = 0;         ///< primitives that were decoded
};

} // namespace

void decodeDraco(Document& document) {
    DracoReader(document).read();
}

} // namespace supple::cage::gltf
