# supple_basisu: Basis Universal's transcoder, of the source that tools/basisu.sh fetches. There is no such target where that is
# not at hand.
set(SUPPLE_BASISU_DIR ${supple_SOURCE_DIR}/build/basis-universal CACHE PATH
    "Source of Basis Universal: the folder of transcoder/ and zstd/")
find_path(SUPPLE_ZSTD_INCLUDE zstd.h)
find_library(SUPPLE_ZSTD_LIBRARY zstd)
mark_as_advanced(SUPPLE_ZSTD_INCLUDE SUPPLE_ZSTD_LIBRARY)
if(NOT TARGET supple_basisu AND EXISTS ${SUPPLE_BASISU_DIR}/transcoder/basisu_transcoder.cpp
   AND SUPPLE_ZSTD_INCLUDE AND SUPPLE_ZSTD_LIBRARY)
    add_library(supple_basisu STATIC EXCLUDE_FROM_ALL ${SUPPLE_BASISU_DIR}/transcoder/basisu_transcoder.cpp)
    target_compile_features(supple_basisu PRIVATE cxx_std_17)
    set_target_properties(supple_basisu PROPERTIES
        POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
    target_include_directories(supple_basisu SYSTEM
        PUBLIC ${SUPPLE_BASISU_DIR}/transcoder PRIVATE ${SUPPLE_ZSTD_INCLUDE})
    # Pictures become RGBA, so none of what GPUs read is made. Its assertions are about files as well: these fail by what
    # it returns.
    foreach(format ASTC ATC BC7 DXT1 DXT5A ETC2_EAC_A8 ETC2_EAC_RG11 FXT1 PVRTC1 PVRTC2)
        target_compile_definitions(supple_basisu PRIVATE BASISD_SUPPORT_${format}=0)
    endforeach()
    target_compile_definitions(supple_basisu PRIVATE BASISD_USE_UNALIGNED_WORD_READS=0 NDEBUG)
    target_compile_options(supple_basisu PRIVATE $<$<CXX_COMPILER_ID:GNU,Clang>:-w>)
    target_link_libraries(supple_basisu PRIVATE ${SUPPLE_ZSTD_LIBRARY})
endif()
