#include "tests/support/spirv_precise.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <unistd.h>

namespace supple::test {

namespace {

// SPIR-V opcodes the walk needs (Khronos SPIR-V specification, section 3.42).
enum Op : uint32_t {
    kName = 5,
    kExtInst = 12,
    kConvertSToF = 111,
    kConvertUToF = 112,
    kControlBarrier = 224,
    kTypeStruct = 30,
    kTypePointer = 32,
    kConstant = 43,
    kFunction = 54,
    kFunctionParameter = 55,
    kFunctionCall = 57,
    kVariable = 59,
    kLoad = 61,
    kStore = 62,
    kAccessChain = 65,
    kInBoundsAccessChain = 66,
    kDecorate = 71,
    kVectorShuffle = 79,
    kCompositeConstruct = 80,
    kCompositeExtract = 81,
    kCompositeInsert = 82,
    kFAdd = 129,
    kFSub = 131,
    kFMul = 133,
    kFDiv = 136,
    kFRem = 140,
    kFMod = 141,
    kVectorTimesScalar = 142,
    kVectorTimesMatrix = 144,
    kMatrixTimesMatrix = 146,
    kDot = 148,
    kSelect = 169,
    kLoopMerge = 246,
    kLabel = 248,
    kReturnValue = 254,
};
constexpr uint32_t kNoContraction = 42;
constexpr uint32_t kWorkgroupStorage = 4, kFunctionStorage = 7;

const char* arithmeticName(uint32_t op) {
    switch (op) {
    case kFAdd:
        return "FAdd";
    case kFSub:
        return "FSub";
    case kFMul:
        return "FMul";
    case kFDiv:
        return "FDiv";
    case kVectorTimesScalar:
        return "VectorTimesScalar";
    case kDot:
        return "Dot";
    default:
        return nullptr;
    }
}

struct Instruction {
    uint32_t op = 0;
    uint32_t type = 0;
    uint32_t result = 0;
    uint32_t function = 0;          ///< id of the function it stands in
    std::vector<uint32_t> operands; ///< without type and result
};

/// A value, or one member of a struct value; a pointer stands for what is stored behind it.
struct Key {
    uint32_t id = 0;
    int member = -1;
    auto operator<=>(const Key&) const = default;
};

class Walk {
public:
    Walk(std::span<const uint32_t> words, bool roots) : roots_(roots) { parse(words); }

    std::vector<std::string> run(const std::string& positionName, uint32_t& checked) {
        for (const auto& [id, name] : names_) {
            if (name == positionName && byResult_.contains(id) &&
                (byResult_[id].op == kVariable || byResult_[id].op == kFunctionParameter)) {
                push({id, -1});
            }
        }
        while (!pending_.empty()) {
            const Key key = pending_.back();
            pending_.pop_back();
            visit(key);
        }
        std::vector<std::string> offences;
        for (const uint32_t id : arithmetic_) {
            if (!noContraction_.contains(id)) {
                offences.push_back(std::string(arithmeticName(byResult_[id].op)) + " in " +
                                   names_[byResult_[id].function]);
            }
        }
        for (const uint32_t id : unknown_) {
            offences.push_back("opcode " + std::to_string(byResult_[id].op) + " in " + names_[byResult_[id].function]);
        }
        checked = static_cast<uint32_t>(arithmetic_.size());
        return offences;
    }

private:
    void parse(std::span<const uint32_t> words) {
        uint32_t function = 0;
        for (size_t at = 5; at < words.size();) {
            const uint32_t count = words[at] >> 16, op = words[at] & 0xFFFFu;
            const std::span<const uint32_t> body = words.subspan(at + 1, count - 1);
            at += count;
            if (op == kName) {
                names_[body[0]] = reinterpret_cast<const char*>(body.data() + 1);
                names_[body[0]] = names_[body[0]].substr(0, names_[body[0]].find('('));
                continue;
            }
            if (op == kDecorate && body[1] == kNoContraction) {
                noContraction_.insert(body[0]);
            }
            Instruction i;
            i.op = op;
            if (op == kTypeStruct) {
                structs_.insert(body[0]);
                continue;
            }
            if (op == kTypePointer) {
                pointees_[body[0]] = body[2];
                continue;
            }
            if (op == kStore || op == kReturnValue) {
                i.operands.assign(body.begin(), body.end());
                i.function = function;
                (op == kStore ? stores_ : returns_).push_back(i);
                continue;
            }
            if (op == kFunction || op == kFunctionParameter || op == kFunctionCall || op == kVariable || op == kLoad ||
                op == kAccessChain || op == kInBoundsAccessChain || op == kConstant || op == kExtInst ||
                (op >= 77 && op <= 250 && op != kControlBarrier)) {
                if (body.size() < 2) {
                    continue;
                }
                i.type = body[0];
                i.result = body[1];
                i.operands.assign(body.begin() + 2, body.end());
                if (op == kFunction) {
                    function = i.result;
                }
                i.function = function;
                if (op == kFunctionParameter) {
                    parameters_[function].push_back(i.result);
                }
                byResult_[i.result] = i;
                if (op == kFunctionCall) {
                    calls_.push_back(i);
                }
            }
        }
    }

    void push(Key key) {
        if (seen_.insert(key).second) {
            pending_.push_back(key);
        }
    }

    /// The variable or parameter behind a pointer, and the member an access chain picks first when it is a struct.
    [[nodiscard]] Key root(uint32_t pointer) const {
        int member = -1;
        while (true) {
            const auto found = byResult_.find(pointer);
            if (found == byResult_.end()) {
                return {pointer, member};
            }
            const Instruction& i = found->second;
            if (i.op != kAccessChain && i.op != kInBoundsAccessChain) {
                return {pointer, member};
            }
            pointer = i.operands[0];
            member = -1;
            const auto base = byResult_.find(pointer);
            if (base != byResult_.end() && pointees_.contains(base->second.type) &&
                structs_.contains(pointees_.at(base->second.type))) {
                const auto index = byResult_.find(i.operands[1]);
                if (index != byResult_.end() && index->second.op == kConstant) {
                    member = static_cast<int>(index->second.operands[0]);
                }
            }
        }
    }

    [[nodiscard]] static bool overlap(int a, int b) { return a == -1 || b == -1 || a == b; }

    /// Opcodes that move or convert values without rounding sums or products, or read them from a buffer or an image.
    [[nodiscard]] static bool harmless(uint32_t op) {
        switch (op) {
        case 83:  // CopyObject
        case 87:  // ImageSampleImplicitLod .. ImageFetch, Image
        case 95:  //
        case 100: //
        case 109: // ConvertFToU, ConvertFToS, of whole numbers
        case 110: //
        case 124: // Bitcast
        case 126: // SNegate, FNegate
        case 127: //
        case 128: // IAdd, ISub, IMul: integers are exact
        case 130: //
        case 132: //
        case 134: // UDiv, UMod, of whole numbers
        case 137: //
        case 170: // IEqual, INotEqual
        case 171: //
        case 194: // ShiftRightLogical, ShiftLeftLogical, BitwiseOr
        case 196: //
        case 197: //
        case 199: // BitwiseAnd: flags that share a struct with points
        case 245: // Phi
            return true;
        default:
            return op == kConstant || op == kAccessChain;
        }
    }

    /// Of GLSL.std.450, what has no rounding.
    [[nodiscard]] static bool exactBuiltIn(uint32_t instruction) {
        return instruction == 4 || instruction == 8 || instruction == 37 || // FAbs, Floor, FMin
               instruction == 40 || instruction == 45 ||                    // FMax, SClamp
               instruction == 50; // Fma: one operation, and the same one wherever it feeds what is precise
    }

    void visit(Key key) {
        const auto found = byResult_.find(key.id);
        if (found == byResult_.end()) {
            return; // a constant or a type
        }
        const Instruction& i = found->second;
        switch (i.op) {
        case kVariable:
        case kFunctionParameter: {
            // Whatever is stored into it, here or through a call it is passed to.
            for (const Instruction& store : stores_) {
                const Key target = root(store.operands[0]);
                if (target.id == key.id && overlap(target.member, key.member)) {
                    push({store.operands[1], target.member == -1 ? key.member : -1});
                }
            }
            for (const Instruction& call : calls_) {
                const std::vector<uint32_t>& parameters = parameters_[call.operands[0]];
                for (size_t a = 0; a < parameters.size(); ++a) {
                    const Key argument = root(call.operands[a + 1]);
                    if (argument.id == key.id && overlap(argument.member, key.member)) {
                        push({parameters[a], argument.member == -1 ? key.member : -1});
                    }
                    if (parameters[a] == key.id) {
                        push({argument.id, argument.member == -1 ? key.member : argument.member});
                    }
                }
            }
            return;
        }
        case kLoad: {
            const Key from = root(i.operands[0]);
            const auto base = byResult_.find(from.id);
            // Buffers, texels and push constants are where values come from; walking ends there.
            if (base != byResult_.end() &&
                (base->second.op == kFunctionParameter ||
                 (base->second.op == kVariable &&
                  (base->second.operands[0] == kFunctionStorage || base->second.operands[0] == kWorkgroupStorage)))) {
                push({from.id, from.member == -1 ? key.member : from.member});
            }
            return;
        }
        case kFunctionCall:
            for (const Instruction& value : returns_) {
                if (value.function == i.operands[0]) {
                    push({value.operands[0], key.member});
                }
            }
            return;
        case kCompositeConstruct:
            if (structs_.contains(i.type) && key.member >= 0) {
                push({i.operands[static_cast<size_t>(key.member)], -1});
            } else {
                for (const uint32_t operand : i.operands) {
                    push({operand, -1});
                }
            }
            return;
        case kCompositeExtract: {
            const auto composite = byResult_.find(i.operands[0]);
            const bool ofStruct = composite != byResult_.end() && structs_.contains(composite->second.type);
            push({i.operands[0], ofStruct ? static_cast<int>(i.operands[1]) : -1});
            return;
        }
        case kVectorShuffle:
        case kCompositeInsert:
            push({i.operands[0], -1});
            push({i.operands[1], -1});
            return;
        case kSelect:
            push({i.operands[1], -1});
            push({i.operands[2], -1});
            return;
        case kConvertSToF:
        case kConvertUToF:
            return; // sample numbers: integers are exact
        default:
            break;
        }
        if (i.op == kExtInst && (exactBuiltIn(i.operands[1]) || (roots_ && i.operands[1] == kSqrt))) {
            for (size_t a = 2; a < i.operands.size(); ++a) {
                push({i.operands[a], -1});
            }
            return;
        }
        if (arithmeticName(i.op) == nullptr && !harmless(i.op)) {
            unknown_.insert(key.id); // a built-in, a matrix product: nothing says that it rounds the same on both sides
        }
        if (arithmeticName(i.op) != nullptr) {
            arithmetic_.insert(key.id);
        }
        if (i.op >= 109 && i.op <= 250) { // conversions and arithmetic
            for (const uint32_t operand : i.operands) {
                push({operand, -1});
            }
        }
    }

    static constexpr uint32_t kSqrt = 31;

    bool roots_ = false;
    std::map<uint32_t, std::string> names_;
    std::map<uint32_t, Instruction> byResult_;
    std::map<uint32_t, uint32_t> pointees_;
    std::set<uint32_t> structs_, noContraction_, arithmetic_, unknown_;
    std::map<uint32_t, std::vector<uint32_t>> parameters_;
    std::vector<Instruction> stores_, returns_, calls_;
    std::set<Key> seen_;
    std::vector<Key> pending_;
};

std::string readText(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

/// Removes `precise ` from the body of every function called `name`; counts the removals.
std::string stripped(const std::string& source, const std::string& name, uint32_t& removals) {
    if (name == "*") {
        std::string all = source;
        for (size_t at = all.find("precise "); at != std::string::npos; at = all.find("precise ", at)) {
            all.erase(at, 8);
            ++removals;
        }
        return all;
    }
    const std::regex definition("\\n(SUPPLE_SHARED_FUNCTION )?[A-Za-z0-9_]+ " + name + "\\([^)]*\\) \\{");
    std::smatch match;
    if (!std::regex_search(source, match, definition)) {
        return source;
    }
    const size_t begin = static_cast<size_t>(match.position(0));
    size_t end = source.find("\n}", begin + 1);
    std::string body = source.substr(begin, end - begin);
    // The headers that C++ compiles too have a word of their own for it.
    for (const std::string word : {"SUPPLE_PRECISE ", "precise "}) {
        for (size_t at = body.find(word); at != std::string::npos; at = body.find(word, at)) {
            body.erase(at, word.size());
            ++removals;
        }
    }
    return source.substr(0, begin) + body + source.substr(end);
}

} // namespace

std::vector<uint32_t> readWords(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    const std::vector<char> bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    std::vector<uint32_t> words(bytes.size() / 4);
    std::memcpy(words.data(), bytes.data(), words.size() * 4);
    return words;
}

std::vector<std::string> operationsThatDriversRound(std::span<const uint32_t> spirv) {
    // GLSL.std.450 from Radians to InverseSqrt; Fma; from Length on, what is made of roots and divisions.
    constexpr uint32_t kRadians = 11, kInverseSqrt = 32, kFma = 50, kLength = 66, kRefract = 72, kCross = 68;
    std::vector<std::string> found;
    for (size_t at = 5; at < spirv.size(); at += spirv[at] >> 16) {
        const uint32_t op = spirv[at] & 0xFFFFu;
        if (op == kFDiv || op == kFRem || op == kFMod || op == kDot ||
            (op >= kVectorTimesMatrix && op <= kMatrixTimesMatrix)) {
            found.push_back("opcode " + std::to_string(op));
        } else if (op == kExtInst) {
            const uint32_t builtIn = spirv[at + 4];
            if ((builtIn >= kRadians && builtIn <= kInverseSqrt) || builtIn == kFma ||
                (builtIn >= kLength && builtIn <= kRefract && builtIn != kCross))
                found.push_back("built-in " + std::to_string(builtIn));
        }
    }
    return found;
}

uint32_t preciseInUnrolledLoops(std::span<const uint32_t> spirv, uint32_t& loops) {
    constexpr uint32_t kUnroll = 1; // of the loop's control mask
    std::set<uint32_t> precise, ends;
    uint32_t found = 0;
    // The blocks of a loop stand between its header and its end.
    for (size_t at = 5; at < spirv.size(); at += spirv[at] >> 16) {
        const uint32_t op = spirv[at] & 0xFFFFu;
        if (op == kDecorate && spirv[at + 2] == kNoContraction) {
            precise.insert(spirv[at + 1]);
        } else if (op == kLoopMerge && (spirv[at + 3] & kUnroll) != 0) {
            ends.insert(spirv[at + 1]);
            ++loops;
        } else if (op == kLabel) {
            ends.erase(spirv[at + 1]);
        } else if (arithmeticName(op) != nullptr && !ends.empty() && precise.contains(spirv[at + 2])) {
            ++found;
        }
    }
    return found;
}

std::vector<std::string> imprecisePositionArithmetic(std::span<const uint32_t> spirv, const std::string& positionName,
                                                     uint32_t& checked, bool roots) {
    return Walk(spirv, roots).run(positionName, checked);
}

namespace {

/// Files below shaders/ that stand in for those of the tree, by their paths there.
using Edits = std::map<std::filesystem::path, std::string>;

/// GLSL below shaders/ with some files edited. `flags`: of the compiler.
std::vector<uint32_t> compileOver(const std::string& path, const std::string& flags, const Edits& edits) {
    namespace fs = std::filesystem;
    const fs::path root = fs::temp_directory_path() / ("supple_precise_" + std::to_string(getpid())),
                   source = SUPPLE_SOURCE_DIR;
    fs::remove_all(root);
    fs::create_directories(root);
    for (const auto& [edited, text] : edits) {
        fs::create_directories((root / "shaders" / edited).parent_path());
        std::ofstream(root / "shaders" / edited) << text;
    }
    const fs::path output = root / "out.spv", from = edits.contains(path) ? root : source;
    const std::string command = std::string(SUPPLE_GLSLANG_COMMAND) + " --quiet -g -V --target-env vulkan1.1 -I" +
                                root.string() + " -I" + source.string() + flags + " -o " + output.string() + " " +
                                (from / "shaders" / path).string();
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    std::vector<uint32_t> words = readWords(output);
    fs::remove_all(root);
    return words;
}

} // namespace

std::vector<uint32_t> compileShader(const std::string& path, const std::string& strip, const std::string& macros) {
    namespace fs = std::filesystem;
    Edits edits;
    uint32_t removals = 0;
    const fs::path shaders = fs::path(SUPPLE_SOURCE_DIR) / "shaders";
    for (const auto& entry : fs::recursive_directory_iterator(shaders)) {
        if (strip.empty() || !entry.is_regular_file()) {
            continue;
        }
        const std::string text = readText(entry.path());
        const bool mayHaveIt = strip == "*" || text.find(strip + "(") != std::string::npos; // searching it takes long
        if (std::string less = mayHaveIt ? stripped(text, strip, removals) : text; less != text) {
            edits.emplace(fs::relative(entry.path(), shaders), std::move(less));
        }
    }
    EXPECT_EQ(removals > 0, !strip.empty()) << strip << " has no precise to strip";
    return compileOver(path, " " + macros, edits);
}

std::vector<uint32_t> compileEdited(const std::string& path, const std::string& from, const std::string& to,
                                    const std::string& macros) {
    std::string text = readText(std::filesystem::path(SUPPLE_SOURCE_DIR) / "shaders" / path);
    const size_t at = text.find(from);
    if (at == std::string::npos || text.find(from, at + 1) != std::string::npos) {
        ADD_FAILURE() << path << " does not have this once: " << from;
        return {};
    }
    text.replace(at, from.size(), to);
    return compileOver(path, " " + macros, {{path, text}});
}

std::vector<uint32_t> optimized(const std::vector<uint32_t>& spirv) {
    namespace fs = std::filesystem;
    const fs::path path = fs::temp_directory_path() / ("supple_precise_" + std::to_string(getpid()) + ".spv");
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(spirv.data()), static_cast<std::streamsize>(spirv.size() * 4));
    const std::string command = std::string(SUPPLE_SPIRV_OPT_COMMAND) + " " + path.string() + " -o " + path.string();
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    std::vector<uint32_t> words = readWords(path);
    fs::remove(path);
    return words;
}

} // namespace supple::test
