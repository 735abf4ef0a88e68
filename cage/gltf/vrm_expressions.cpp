#include "cage/gltf/vrm_expressions.h"

#include "cage/entry_faults.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace supple::cage::gltf {
namespace {

/// The presets, in the order of VRM 1.0.
constexpr struct {
    std::string_view name;
    std::string_view old; ///< of VRM 0.x; empty: it has none
    ExpressionKind kind;
} kPresets[] = {
    {"happy", "joy", ExpressionKind::other},
    {"angry", "angry", ExpressionKind::other},
    {"sad", "sorrow", ExpressionKind::other},
    {"relaxed", "fun", ExpressionKind::other},
    {"surprised", "", ExpressionKind::other},
    {"aa", "a", ExpressionKind::mouth},
    {"ih", "i", ExpressionKind::mouth},
    {"ou", "u", ExpressionKind::mouth},
    {"ee", "e", ExpressionKind::mouth},
    {"oh", "o", ExpressionKind::mouth},
    {"blink", "blink", ExpressionKind::blink},
    {"blinkLeft", "blink_l", ExpressionKind::blink},
    {"blinkRight", "blink_r", ExpressionKind::blink},
    {"lookUp", "lookup", ExpressionKind::look},
    {"lookDown", "lookdown", ExpressionKind::look},
    {"lookLeft", "lookleft", ExpressionKind::look},
    {"lookRight", "lookright", ExpressionKind::look},
    {"neutral", "neutral", ExpressionKind::other},
};

/// What VRM 1.0 calls how an expression holds back those of a kind.
constexpr struct {
    const char* member;
    ExpressionKind kind;
} kHolds[] = {{"overrideBlink", ExpressionKind::blink},
              {"overrideLookAt", ExpressionKind::look},
              {"overrideMouth", ExpressionKind::mouth}};

/// What expressions do to materials.
constexpr const char* kMaterialMembers[] = {"materialColorBinds", "textureTransformBinds", "materialValues"};

class ExpressionReader {
public:
    ExpressionReader(const Document& document, std::span<const size_t> targetCounts, Warnings& warnings)
        : document_(document), targetCounts_(targetCounts), warnings_(warnings) {}

    std::vector<UnplacedExpression> read() && {
        const Json* extensions = member(document_.json.root(), "extensions");
        if (const Json* vrm = objectIn(extensions, "VRMC_vrm"); objectIn(vrm, "expressions") != nullptr) {
            readNew(*objectIn(vrm, "expressions"));
        } else if (const Json* master = objectIn(objectIn(extensions, "VRM"), "blendShapeMaster"); master != nullptr) {
            readOld(*master);
        }
        if (movesMaterials_ > 0) {
            warn(warnings_, "VRM",
                 counted(movesMaterials_, "expression changes", "expressions change") +
                     " materials, which is not read");
        }
        return std::move(expressions_);
    }

private:
    void readNew(const Json& from) {
        const Json* presets = objectIn(&from, "preset");
        for (const auto& preset : kPresets) {
            if (const Json* own = objectIn(presets, std::string(preset.name).c_str()); own != nullptr) {
                readNew(*own, {.name = std::string(preset.name), .kind = preset.kind});
            }
        }
        if (const Json* custom = objectIn(&from, "custom"); custom != nullptr) {
            for (const JsonMember& own : custom->members()) {
                if (!own.name.empty() && own.value.isObject()) {
                    readNew(own.value, {.name = std::string(own.name)});
                }
            }
        }
    }

    void readNew(const Json& from, Expression expression) {
        const Json* binary = member(from, "isBinary");
        expression.isBinary = binary != nullptr && binary->boolean();
        for (const auto& [key, kind] : kHolds) {
            const Json* hold = member(from, key);
            const std::string_view how = hold != nullptr && hold->isString() ? hold->text() : std::string_view();
            expression.holds[static_cast<size_t>(kind)] = how == "block"   ? ExpressionHold::block
                                                          : how == "blend" ? ExpressionHold::blend
                                                                           : ExpressionHold::none;
        }
        readBinds(from, "morphTargetBinds", "node", 1.0f, std::move(expression));
    }

    void readOld(const Json& master) {
        const Json* groups = member(master, "blendShapeGroups");
        if (groups == nullptr || !groups->isArray()) {
            return;
        }
        EntryFaults faults("VRM blendShapeGroups");
        for (size_t i = 0; i < groups->size(); ++i) {
            const Json& group = (*groups)[i];
            Expression expression;
            if (const Json* name = group.isObject() ? member(group, "name") : nullptr; name != nullptr) {
                expression.name = name->string();
            }
            const Json* given = group.isObject() ? member(group, "presetName") : nullptr;
            const auto preset = std::find_if(std::begin(kPresets), std::end(kPresets), [&](const auto& known) {
                return given != nullptr && given->isString() && !known.old.empty() && known.old == given->text();
            });
            if (preset != std::end(kPresets)) {
                expression.name = std::string(preset->name);
                expression.kind = preset->kind;
            }
            if (expression.name.empty()) {
                faults.add(i, "it has no name");
                continue;
            }
            const Json* binary = member(group, "isBinary");
            expression.isBinary = binary != nullptr && binary->boolean();
            readBinds(group, "binds", "mesh", 100.0f, std::move(expression));
        }
        faults.report(warnings_);
    }

    /// `owner`: what a bind names, a node or the mesh of nodes. `full`: the weight that is 1.
    void readBinds(const Json& from, const char* key, const char* owner, float full, Expression expression) {
        const std::string element = "VRM expression " + cage::quoted(expression.name);
        document_.memory->take(sizeof(UnplacedExpression) + expression.name.size(), element);
        movesMaterials_ += std::any_of(std::begin(kMaterialMembers), std::end(kMaterialMembers),
                                       [&](const char* name) {
                                           const Json* own = member(from, name);
                                           return own != nullptr && !own->empty();
                                       })
                               ? 1
                               : 0;
        UnplacedExpression read{std::move(expression), {}};
        const Json* binds = member(from, key);
        EntryFaults faults(element + " " + key);
        for (size_t i = 0; binds != nullptr && i < binds->size(); ++i) {
            if (const std::optional<std::string> fault = readBind((*binds)[i], owner, full, read.binds)) {
                faults.add(i, *fault);
            }
        }
        faults.report(warnings_);
        expressions_.push_back(std::move(read));
    }

    std::optional<std::string> readBind(const Json& from, const char* owner, float full,
                                        std::vector<ExpressionBind>& binds) {
        const auto numberOf = [&](const char* key) { return from.isObject() ? member(from, key) : nullptr; };
        const Json *own = numberOf(owner), *index = numberOf("index"), *weight = numberOf("weight");
        if (own == nullptr || !own->isUnsigned() || index == nullptr || !index->isUnsigned()) {
            return std::string(owner) + " or index is not a number from 0 on";
        }
        if (weight == nullptr || !weight->isNumber() || !isFiniteFloat(*weight)) {
            return "weight is not a finite number";
        }
        bool found = false;
        for (const uint32_t node : nodesOf(owner, own->unsignedInteger())) {
            if (index->unsignedInteger() >= targetCounts_[node]) {
                continue;
            }
            if (++bindCount_ > kMostExpressionBinds) {
                return "expressions move more than " + std::to_string(kMostExpressionBinds) + " morph targets";
            }
            document_.memory->take(sizeof(ExpressionBind), "VRM expressions");
            found = true;
            binds.push_back({node, static_cast<uint32_t>(index->unsignedInteger()), weight->real() / full});
        }
        return found ? std::nullopt : std::optional<std::string>("no part has that morph target");
    }

    /// The nodes that carry a mesh, or the node itself.
    std::vector<uint32_t> nodesOf(std::string_view owner, uint64_t number) {
        if (owner == "node") {
            return number < targetCounts_.size() ? std::vector{static_cast<uint32_t>(number)} : std::vector<uint32_t>{};
        }
        if (meshNodes_.empty()) {
            meshNodes_.resize(document_.model.meshes.size());
            for (uint32_t node = 0; node < document_.model.nodes.size(); ++node) {
                const int mesh = document_.model.nodes[node].mesh;
                if (mesh >= 0 && static_cast<size_t>(mesh) < meshNodes_.size() && targetCounts_[node] > 0) {
                    meshNodes_[static_cast<size_t>(mesh)].push_back(node);
                }
            }
        }
        return number < meshNodes_.size() ? meshNodes_[number] : std::vector<uint32_t>{};
    }

    const Document& document_;
    std::span<const size_t> targetCounts_;
    Warnings& warnings_;
    std::vector<UnplacedExpression> expressions_;
    std::vector<std::vector<uint32_t>> meshNodes_;
    size_t bindCount_ = 0;
    size_t movesMaterials_ = 0; ///< expressions
};

} // namespace

std::vector<UnplacedExpression> readExpressions(const Document& document, std::span<const size_t> targetCounts,
                                                Warnings& warnings) {
    return ExpressionReader(document, targetCounts, warnings).read();
}

} // namespace supple::cage::gltf
