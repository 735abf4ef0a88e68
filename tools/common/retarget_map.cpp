#include "tools/common/retarget_map.h"

#include "cage/message.h"
#include "skinning/roles.h"

#include <nlohmann/json.hpp>

namespace supple::host {
namespace {

using Json = nlohmann::json;

class MapReader {
public:
    explicit MapReader(const std::string& name) : name_(name) {}

    Result<std::vector<JointPairSetting>> read(const Json& json) {
        if (!json.is_object()) {
            fault("must be an object with \"roles\" and \"joints\"");
        } else {
            for (const auto& [key, value] : json.items()) {
                if (key == "roles" && value.is_object()) {
                    readRoles(value);
                } else if (key == "joints" && value.is_array()) {
                    readJoints(value);
                } else if (key == "roles" || key == "joints") {
                    fault(key + (key == "roles" ? ": must be an object" : ": must be an array"));
                } else {
                    fault("unknown key " + cage::quoted(key) + "; there are \"roles\" and \"joints\"");
                }
            }
        }
        if (!faults_.empty()) {
            return Error{ErrorCode::argument, faults_};
        }
        return pairs_;
    }

private:
    void fault(const std::string& reason) {
        faults_ += (faults_.empty() ? "" : "\n") + cage::oneLine(name_ + ": " + reason);
    }
    void readRoles(const Json& roles) {
        for (const auto& [role, pair] : roles.items()) {
            if (!skinning::roleNamed(role)) {
                fault("no role is called " + cage::quoted(role));
            } else if (readPair(role, pair, "roles " + cage::quoted(role)) && pairs_.back().from.empty() &&
                       pairs_.back().to.empty()) {
                fault("roles " + cage::quoted(role) + ": needs from, to or both");
            }
        }
    }
    void readJoints(const Json& joints) {
        for (size_t i = 0; i < joints.size(); ++i) {
            const std::string element = cage::at("joint", i);
            if (readPair("", joints[i], element) && (pairs_.back().from.empty() || pairs_.back().to.empty())) {
                fault(element + ": needs from and to");
            }
        }
    }
    /// Whether it is there; then it is the last one.
    bool readPair(const std::string& role, const Json& pair, const std::string& element) {
        if (!pair.is_object()) {
            fault(element + ": must be an object with from and to");
            return false;
        }
        JointPairSetting setting{role, {}, {}};
        for (const auto& [key, value] : pair.items()) {
            std::string* const text = key == "from" ? &setting.from : key == "to" ? &setting.to : nullptr;
            if (text == nullptr || !value.is_string()) {
                fault(element + ": " +
                      (text == nullptr ? "unknown key " + cage::quoted(key) : key + " must be a name"));
                return false;
            }
            *text = value.get<std::string>();
        }
        pairs_.push_back(std::move(setting));
        return true;
    }

    std::string name_, faults_;
    std::vector<JointPairSetting> pairs_;
};

} // namespace

Result<std::vector<JointPairSetting>> parseRetargetMap(const std::string& text, const std::string& name) {
    const Json json = Json::parse(text, nullptr, false);
    if (json.is_discarded()) {
        return Error{ErrorCode::argument, name + ": is no JSON"};
    }
    return MapReader(name).read(json);
}

std::vector<SuppleJointPair> jointPairsOf(const std::vector<JointPairSetting>& settings) {
    const auto orNull = [](const std::string& text) { return text.empty() ? nullptr : text.c_str(); };
    std::vector<SuppleJointPair> pairs;
    for (const JointPairSetting& setting : settings) {
        pairs.push_back({orNull(setting.role), orNull(setting.from), orNull(setting.to)});
    }
    return pairs;
}

} // namespace supple::host
