// A group on the CPU, made of a cage or of a file, for the tests.
#pragma once

#include "cage/character.h"
#include "tools/common/cage_arrays.h"

#include <supple/supple_cpu.h>

#include <cstdint>
#include <fstream>
#include <glm/glm.hpp>
#include <gtest/gtest.h>
#include <iterator>
#include <string>
#include <vector>

namespace supple::test {

struct CpuOptions {
    SuppleScheme scheme = SUPPLE_SCHEME_AUTO;
    uint32_t rate = 8;
    SuppleFragmentRules rules = SUPPLE_RULES_CATMULL_CLARK;
    SuppleCornerRule corners = SUPPLE_CORNERS_SHARP;
    std::vector<SuppleScheme> partSchemes;
};

class CpuGroup {
public:
    CpuGroup(const cage::Cage& cage, const CpuOptions& options) {
        const host::CageArrays arrays(cage);
        SuppleAssetDesc asset{};
        asset.structSize = sizeof(asset);
        asset.name = "test cage";
        asset.cage = &arrays.desc;
        create(asset, options);
    }
    CpuGroup(const std::string& path, const CpuOptions& options) {
        std::ifstream file(path, std::ios::binary);
        const std::vector<char> bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
        SuppleAssetDesc asset{};
        asset.structSize = sizeof(asset);
        asset.name = path.c_str();
        asset.bytes = bytes.data();
        asset.byteCount = bytes.size();
        create(asset, options);
    }
    ~CpuGroup() {
        suppleCpuDestroyPose(pose_);
        suppleCpuDestroyGroup(group_);
    }
    CpuGroup(const CpuGroup&) = delete;
    CpuGroup& operator=(const CpuGroup&) = delete;

    [[nodiscard]] bool valid() const { return pose_ != nullptr; }
    [[nodiscard]] SuppleCpuGroup handle() const { return group_; }
    [[nodiscard]] SuppleCpuPose pose() const { return pose_; }
    [[nodiscard]] const std::vector<std::string>& lines() const { return lines_; }
    [[nodiscard]] SuppleResult result() const { return result_; }

    [[nodiscard]] SuppleResult build(const std::vector<glm::vec3>& cage, const SuppleCpuJobs* jobs = nullptr) {
        return suppleCpuBuildPose(pose_, &cage[0].x, sizeof(glm::vec3), static_cast<uint32_t>(cage.size()), jobs);
    }
    [[nodiscard]] SuppleCpuGroupInfo info() const {
        SuppleCpuGroupInfo info{};
        info.structSize = sizeof(info);
        EXPECT_EQ(suppleCpuGetGroupInfo(group_, &info), SUPPLE_OK);
        return info;
    }
    [[nodiscard]] SuppleCpuGridInfo grid(uint32_t surface, uint32_t rate) const {
        SuppleCpuGridInfo info{};
        info.structSize = sizeof(info);
        EXPECT_EQ(suppleCpuGetGridInfo(group_, surface, rate, &info), SUPPLE_OK);
        return info;
    }
    [[nodiscard]] std::vector<SupplePatchInfo> patches(uint32_t surface) const {
        uint32_t count = 0;
        EXPECT_EQ(suppleCpuGetPatches(group_, surface, nullptr, &count), SUPPLE_OK);
        std::vector<SupplePatchInfo> patches(count);
        EXPECT_EQ(suppleCpuGetPatches(group_, surface, patches.data(), &count), SUPPLE_OK);
        return patches;
    }
    struct Vertices {
        std::vector<glm::vec3> positions, normals;
    };
    [[nodiscard]] Vertices evaluate(uint32_t surface, uint32_t rate, const SuppleCpuJobs* jobs = nullptr) const {
        const uint32_t count = grid(surface, rate).vertexCount;
        Vertices vertices{std::vector<glm::vec3>(count), std::vector<glm::vec3>(count)};
        EXPECT_EQ(
            suppleCpuEvaluateGrid(pose_, surface, rate, &vertices.positions[0].x, &vertices.normals[0].x, count, jobs),
            SUPPLE_OK);
        return vertices;
    }
    [[nodiscard]] std::vector<SuppleSurfaceJet> at(const std::vector<SuppleSurfacePoint>& points,
                                                   const SuppleCpuJobs* jobs = nullptr) const {
        std::vector<SuppleSurfaceJet> jets(points.size());
        EXPECT_EQ(
            suppleCpuEvaluatePoints(pose_, points.data(), static_cast<uint32_t>(points.size()), jets.data(), jobs),
            SUPPLE_OK)
            << (lines_.empty() ? "" : lines_.back());
        return jets;
    }

private:
    static void log(SuppleSeverity severity, SuppleMessage, const char* text, void* user) {
        if (severity == SUPPLE_SEVERITY_ERROR) {
            static_cast<std::vector<std::string>*>(user)->emplace_back(text);
        }
    }

    void create(const SuppleAssetDesc& asset, const CpuOptions& options) {
        SupplePrepareDesc prepare{};
        prepare.structSize = sizeof(prepare);
        prepare.asset = &asset;
        prepare.log = &log;
        prepare.logUser = &lines_;
        SupplePrepared prepared = nullptr;
        EXPECT_EQ(supplePrepare(&prepare, &prepared), SUPPLE_OK) << (lines_.empty() ? "" : lines_.back());
        const SuppleFragmentsOptions fragments{sizeof(fragments), options.rules};
        const SupplePrepOptions prep{sizeof(prep), SUPPLE_TANGENTS_DEFAULT, options.corners};
        SuppleGroupDesc group{};
        group.structSize = sizeof(group);
        group.scheme = options.scheme;
        group.rate = options.rate;
        group.fragments = &fragments;
        group.prep = &prep;
        group.partSchemes = options.partSchemes.data();
        group.partSchemeCount = static_cast<uint32_t>(options.partSchemes.size());
        SuppleCpuGroupDesc desc{};
        desc.structSize = sizeof(desc);
        desc.prepared = prepared;
        desc.group = &group;
        desc.log = &log;
        desc.logUser = &lines_;
        result_ = suppleCpuCreateGroup(&desc, &group_);
        suppleDestroyPrepared(prepared);
        if (result_ == SUPPLE_OK) {
            EXPECT_EQ(suppleCpuCreatePose(group_, &pose_), SUPPLE_OK);
        }
    }

    std::vector<std::string> lines_;
    SuppleResult result_ = SUPPLE_OK;
    SuppleCpuGroup group_ = nullptr;
    SuppleCpuPose pose_ = nullptr;
};

} // namespace supple::test
