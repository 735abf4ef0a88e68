/**
 * @file supple_playback.h
 * Layers of clips: poses that the CPU samples, root motion, and clips that the device plays. supple.h includes this
 * header.
 */
#ifndef SUPPLE_PLAYBACK_H
#define SUPPLE_PLAYBACK_H

#include "supple.h"

#ifdef __cplusplus
extern "C" {
#endif

#define SUPPLE_MAX_PLAYBACK_LAYERS 8u /**< see suppleSetPlayback */
#define SUPPLE_MAX_MASKS 16u          /**< of a group: see suppleSetMask */
#define SUPPLE_MAX_TIME 1e9           /**< seconds: times of playback lie between minus this and this */

/* ---------------------------------------------------------------------------------------------------- layers */

/** How a layer changes the pose below it.
 * BLEND: the pose moves towards the clip's by the weight, 0..1: rotations along the shorter arc, all else straight.
 * Weight 1 replaces the pose, weight 0 leaves it, both to the bit.
 * ADDITIVE: adds the difference between the clip and its own pose at referenceTime, times the weight w, of any size and
 * sign: rotations in the joint's own frame, pose * (reference^-1 * clip)^w; scales as factors; translations and morph
 * weights as sums. */
typedef enum SuppleLayerMode { SUPPLE_LAYER_BLEND = 0, SUPPLE_LAYER_ADDITIVE = 1 } SuppleLayerMode;

/** Options of a layer. */
typedef enum SuppleLayerFlags {
    SUPPLE_LAYER_LOOP = 1 /**< times wrap round at the clip's duration; else they are clamped to the clip */
} SuppleLayerFlags;

/** One clip of a pose. The bind and rest poses are no clips: a pose without layers is the rest pose. */
typedef struct SuppleClipLayer {
    uint32_t clip;
    uint32_t flags; /**< SuppleLayerFlags */
    SuppleLayerMode mode;
    float weight;           /**< 0 leaves the layer out */
    double time;            /**< seconds */
    double previousTime;    /**< suppleGetRootMotion: the movement from here to time */
    double referenceTime;   /**< ADDITIVE: 0 is the clip's first pose */
    const float* jointMask; /**< optional: per joint a value 0..1 that multiplies the weight. Nodes that are no joints
                             * follow the joint above them or, without one, the first joint below */
    uint32_t jointMaskCount;
    uint32_t morphMaskCount;
    const float* morphMask; /**< optional: per morph target a value 0..1. Null: 0 if there is a jointMask, else 1 */
} SuppleClipLayer;

/** Sets mask[joint], and mask of every joint below it, to value. The others stay. mask has jointCount values. */
SUPPLE_API SuppleResult suppleFillJointMask(SuppleContext context, SuppleAsset asset, uint32_t joint, float value,
                                            float* mask, uint32_t jointCount);

/** Which part of the root's movement belongs to the character instead of the pose; in model space, where +Y is up. */
typedef enum SuppleRootMotionFlags {
    SUPPLE_ROOT_MOTION_GROUND = 1, /**< translation along x and z */
    SUPPLE_ROOT_MOTION_HEIGHT = 2, /**< translation along y */
    SUPPLE_ROOT_MOTION_YAW = 4     /**< the turn about +Y */
} SuppleRootMotionFlags;

/** Options of a pose. */
typedef enum SupplePoseFlags {
    /** rootJoint names the root. Else the root is the topmost node that clips move or turn; of several, the one above
     * most joints. */
    SUPPLE_POSE_ROOT_JOINT = 1
} SupplePoseFlags;

/** Layers are applied in order to the rest pose. A crossfade is two layers: the old clip with weight 1, then the new
 * one with a weight that rises from 0 to 1. */
typedef struct SupplePoseDesc {
    uint32_t structSize;
    uint32_t flags; /**< SupplePoseFlags */
    const SuppleClipLayer* layers;
    uint32_t layerCount;
    uint32_t rootMotion; /**< SuppleRootMotionFlags: taken out of every layer's clip; the root stays where the clip
                          * starts */
    uint32_t rootJoint;
} SupplePoseDesc;

/** Poses an instance (SUPPLE_POSES_SET). The arrays are read during the call. */
SUPPLE_API SuppleResult suppleSetPose(SuppleContext context, SuppleInstance instance, const SupplePoseDesc* pose);

/** A movement of the root: first the turn, then the translation. */
typedef struct SuppleRootMotion {
    uint32_t structSize;
    float translation[3];
    float yaw;           /**< radians about +Y, the shorter way */
    float transform[16]; /**< column-major: turns by yaw, then translates */
} SuppleRootMotion;

/** How far the root moves under pose, from every layer's previousTime to its time, in the character's frame at
 * previousTime: an instance placed by T comes to T * transform (suppleSetTransform). The movement goes on over the ends
 * of looping clips. BLEND layers blend their movements as their poses, by the mask's value at the root. ADDITIVE layers
 * add theirs. If the host sets the same pose, clip and host together move the character as the clip alone did. */
SUPPLE_API SuppleResult suppleGetRootMotion(SuppleContext context, SuppleAsset asset, const SupplePoseDesc* pose,
                                            SuppleRootMotion* out);

/* ---------------------------------------------------------------------------------------------------- playback */

/** One clip that an instance plays. T is the group's time (suppleSetTime). The clip's time is
 * offset + speed * (T - startTime). Without a fade, the weight is `weight`. With one, it goes straight from weight to
 * fadeWeight while T goes from fadeStart to fadeStart + fadeDuration. At every T the layer is the SuppleClipLayer of
 * that time and weight. */
typedef struct SupplePlaybackLayer {
    uint32_t clip;
    uint32_t flags;       /**< SuppleLayerFlags */
    SuppleLayerMode mode; /**< as in SuppleClipLayer */
    uint32_t mask;        /**< a mask of the group's (suppleSetMask); 0: none */
    float weight;         /**< 0 leaves the layer out */
    float fadeWeight;     /**< with a fade: where it ends */
    float fadeDuration;   /**< seconds; 0: no fade */
    float speed;          /**< seconds of the clip per second of T, -1000..1000; 0: the clip stands at offset */
    double startTime;     /**< T at which the clip is at offset */
    double offset;        /**< seconds of the clip */
    double fadeStart;
    double referenceTime; /**< ADDITIVE: 0 is the clip's first pose */
} SupplePlaybackLayer;

/** Options of playback. */
typedef enum SupplePlaybackFlags {
    SUPPLE_PLAYBACK_ROOT_JOINT = 1, /**< as SUPPLE_POSE_ROOT_JOINT */
    /** The instance moves by what rootMotion takes out of the first layer's clip: it is placed by T * M, where T is
     * that of suppleSetTransform and M the movement since the layer's startTime, on over the ends of a looping clip.
     * The layer's weight and mask make no difference. */
    SUPPLE_PLAYBACK_TRAVEL = 2
} SupplePlaybackFlags;

/** Layers are applied in order to the rest pose, as those of SupplePoseDesc. */
typedef struct SupplePlaybackDesc {
    uint32_t structSize;
    uint32_t flags; /**< SupplePlaybackFlags */
    const SupplePlaybackLayer* layers;
    uint32_t layerCount; /**< at most SUPPLE_MAX_PLAYBACK_LAYERS */
    uint32_t rootMotion; /**< SuppleRootMotionFlags: what is taken out of every layer's clip */
    uint32_t rootJoint;
} SupplePlaybackDesc;

/** Groups with SUPPLE_POSES_PLAYBACK: sets what an instance plays from the next suppleRecord on, until it is set again.
 * The array is read during the call. Poses then follow from the group's time alone, on the device. In a frame in which
 * nothing is set, nothing is uploaded, and the host's work is the same for any number of instances. suppleSetTransform
 * and suppleSetMorphWeights work as well. Poses agree with suppleSetPose's except for rounding (docs/playback.md). */
SUPPLE_API SuppleResult suppleSetPlayback(SuppleContext context, SuppleInstance instance,
                                          const SupplePlaybackDesc* playback);
/** Sets T, the time by which the instances of a group with SUPPLE_POSES_PLAYBACK play; 0 at first. It may rise or fall
 * by any amount. */
SUPPLE_API SuppleResult suppleSetTime(SuppleContext context, SuppleGroup group, double seconds);

/** A mask for the layers of a group's instances. */
typedef struct SuppleMaskDesc {
    uint32_t structSize;
    uint32_t mask;          /**< its number, 1..SUPPLE_MAX_MASKS */
    const float* jointMask; /**< as in SuppleClipLayer, and so the next; not both null */
    const float* morphMask;
    uint32_t jointMaskCount;
    uint32_t morphMaskCount;
} SuppleMaskDesc;
/** Sets one of the masks of a group with SUPPLE_POSES_PLAYBACK. Set a mask before layers name it. If it is set again,
 * the layers that name it follow. */
SUPPLE_API SuppleResult suppleSetMask(SuppleContext context, SuppleGroup group, const SuppleMaskDesc* mask);

#ifdef __cplusplus
}
#endif
#endif
