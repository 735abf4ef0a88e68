// Levels before the budget, in an instance's scratch (shared/lod.h).
#ifdef TASKS // tasks stand for many frames: their push constants have no camera
layout(buffer_reference, std430) readonly buffer ViewHead { uint before[kLodCamera]; LodCamera camera; };
LodCamera cameraOfView = ViewHead(bufferOfTask(kLodBinding)).camera;
#define LOD_CAMERA cameraOfView
#else
#define LOD_CAMERA push.camera
#endif
#include "shaders/lod/measure.glsl"
#include "shaders/lod/scratch.glsl"

// The one level of an instance, where it has one.
float levelOfEntry(uint entry) { return uintBitsToFloat(instanceWord(push.window.firstInstance + entry + push.levels)); }
