#include "cage/gltf/json_tree.h"

#include "cage/refusal.h"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <type_traits>

namespace supple::cage::gltf {

static_assert(sizeof(Json) <= 16 && sizeof(JsonMember) <= 32, "a file of \"0,0,0...\" becomes eight times its size");

/// What nlohmann's parser calls.
class JsonTree::Builder {
public:
    explicit Builder(JsonTree& tree, const JsonCount& count) : tree_(tree) {
        tree.items_.reserve(count.items);
        tree.members_.reserve(count.members);
        tree.texts_.reserve(count.bytes);
        pending_.reserve(count.items + count.members);
    }

    bool null() { return add(Json()); }
    bool boolean(bool value) { return add(Json(value)); }
    bool number_integer(int64_t value) { return add(Json(value)); }
    bool number_unsigned(uint64_t value) { return add(Json(value)); }
    bool number_float(double value, const std::string&) { return add(Json(value)); }
    bool string(const std::string& text) { return add(Json(kept(text))); }
    bool binary(const std::vector<uint8_t>&) { return false; } // not in text
    bool start_object(size_t) { return open(); }
    bool start_array(size_t) { return open(); }
    bool key(const std::string& name) {
        name_ = kept(name);
        return true;
    }

    bool end_array() {
        const size_t first = tree_.items_.size();
        for (size_t i = opened_.back().first; i < pending_.size(); ++i) {
            tree_.items_.push_back(pending_[i].value);
        }
        return close(Json(std::span(std::as_const(tree_.items_)).subspan(first)));
    }

    /// If several members have one name, the last counts.
    bool end_object() {
        const auto from = pending_.begin() + static_cast<std::ptrdiff_t>(opened_.back().first);
        std::stable_sort(from, pending_.end(),
                         [](const JsonMember& a, const JsonMember& b) { return a.name < b.name; });
        const size_t first = tree_.members_.size();
        for (auto it = from; it != pending_.end(); ++it) {
            if (it + 1 == pending_.end() || it->name != (it + 1)->name) {
                tree_.members_.push_back(*it);
            }
        }
        return close(Json(std::span(std::as_const(tree_.members_)).subspan(first)));
    }

    [[noreturn]] bool parse_error(size_t, const std::string&, const nlohmann::detail::exception& error) {
        // "[json.exception.parse_error.101] parse error at line 1, column 2: ..." -> from "parse error" on
        const std::string what = error.what();
        const size_t end = what.find("] ");
        std::string reason = end == std::string::npos ? what : what.substr(end + 2);
        if (reason.size() > 200) {
            reason = reason.substr(0, 200) + "...";
        }
        refuse("JSON", reason);
    }

private:
    struct Opened {
        std::string_view name;
        size_t first; ///< pending value
    };

    bool add(Json value) {
        pending_.push_back({name_, value});
        return true;
    }
    bool open() {
        opened_.push_back({name_, pending_.size()});
        return true;
    }
    bool close(Json value) {
        name_ = opened_.back().name;
        pending_.resize(opened_.back().first);
        opened_.pop_back();
        if (opened_.empty()) {
            tree_.root_ = value;
        }
        return add(value);
    }
    std::string_view kept(const std::string& text) {
        const size_t first = tree_.texts_.size();
        tree_.texts_.insert(tree_.texts_.end(), text.begin(), text.end());
        return {tree_.texts_.data() + first, text.size()};
    }

    JsonTree& tree_;
    std::vector<JsonMember> pending_; ///< of the arrays and objects that are open
    std::vector<Opened> opened_;
    std::string_view name_;
};

JsonTree::JsonTree(std::string_view text, const JsonCount& count) {
    Builder builder(*this, count);
    nlohmann::json::sax_parse(text.begin(), text.end(), &builder);
}

Json::Json(std::span<const JsonMember> members)
    : kind_(Kind::object), size_(static_cast<uint32_t>(members.size())), members_(members.data()) {}

double Json::number() const {
    switch (kind_) {
    case Kind::unsignedInteger:
        return static_cast<double>(unsigned_);
    case Kind::negativeInteger:
        return static_cast<double>(negative_);
    case Kind::real:
        return real_;
    default:
        return 0.0;
    }
}

std::span<const JsonMember> Json::members() const {
    return isObject() ? std::span(members_, size_) : std::span<const JsonMember>();
}

const Json* Json::find(std::string_view name) const {
    const auto all = members();
    const auto found = std::lower_bound(
        all.begin(), all.end(), name, [](const JsonMember& member, std::string_view key) { return member.name < key; });
    return found == all.end() || found->name != name ? nullptr : &found->value;
}

const Json& Json::at(std::string_view name) const {
    static constexpr Json kNull{};
    const Json* found = find(name);
    return found != nullptr ? *found : kNull;
}

namespace {

/// Stops where there is enough, so that recursion through a large value ends soon; its depth is bounded by the parser.
void show(const Json& value, size_t most, std::string& text) {
    if (text.size() >= most) {
        return;
    }
    char number[32];
    switch (value.kind()) {
    case Json::Kind::null:
        text += "null";
        break;
    case Json::Kind::boolean:
        text += value.boolean() ? "true" : "false";
        break;
    case Json::Kind::unsignedInteger:
        text += std::to_string(value.unsignedInteger());
        break;
    case Json::Kind::negativeInteger:
        text += std::to_string(value.negativeInteger());
        break;
    case Json::Kind::real:
        text.append(number, std::to_chars(number, number + sizeof number, value.number()).ptr);
        break;
    case Json::Kind::string:
        text += '"' + std::string(value.text().substr(0, most)) + '"';
        break;
    case Json::Kind::array:
        text += '[';
        for (const Json& item : value) {
            text += &item == value.begin() ? "" : ",";
            show(item, most, text);
            if (text.size() >= most) {
                return;
            }
        }
        text += ']';
        break;
    case Json::Kind::object:
        text += value.members().empty() ? "{}" : "{...}";
        break;
    }
}

} // namespace

std::string shown(const Json& value, size_t most) {
    std::string text;
    show(value, most, text);
    return text.substr(0, most);
}

} // namespace supple::cage::gltf
