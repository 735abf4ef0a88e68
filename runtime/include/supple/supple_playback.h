/**
 * @file supple_playback.h
 * Layers of clips: poses that the CPU computes, root motion, and clips that the device plays. supple.h includes this
 * header.
 */
#ifndef SUPPLE_PLAYBACK_H
#define SUPPLE_PLAYBACK_H

#include "supple.h"

#ifdef __cplusplus
extern "C" {
#endif

#define SUPPLE_MAX_PLAYBACK_LAYERS 8u /**< see suppleSetPlayback */
#define SUPPLE_MAX_MASKS 16u          /**< per group: see suppleSetMask */
#define SUPPLE_MAX_TIME 1e9           /**< seconds: all times of playback must be within plus or minus this */

/* ---------------------------------------------------------------------------------------------------- layers */

/** How a layer changes the pose below it.
 * BLEND: interpolates from the pose to the clip's pose by the weight, 0..1. Rotations take the shorter arc, all else is
 * linear. Weight 1 gives the clip's pose and weight 0 leaves the pose, both bit for bit.
 * ADDITIVE: adds w times the difference between the clip's pose and its own pose at referenceTime. The weight w may
 * have any size and sign. Rotations: pose * (reference^-1 * clip)^w, in the joint's own frame. Scales are multiplied,
 * translations and morph weights are added. */
typedef enum SuppleLayerMode {
    SUPPLE_LAYER_BLEND = 0,
    SUPPLE_LAYER_ADDITIVE = 1,
    SUPPLE_LAYER_MAX_ENUM = 0x7FFFFFFF
} SuppleLayerMode;

/** Options of a layer. */
typedef enum SuppleLayerFlags {
    SUPPLE_LAYER_LOOP = 1 /**< times wrap round at the clip's duration; else they are clamped to the clip */
} SuppleLayerFlags;

/** One clip of a pose. SUPPLE_BIND_POSE and SUPPLE_REST_POSE are not allowed: a pose without layers is the rest pose.
 */
typedef struct SuppleClipLayer {
    uint32_t clip;
    uint32_t flags; /**< SuppleLayerFlags */
    SuppleLayerMode mode;
    float weight;            /**< 0 leaves the layer out */
    double time;             /**< seconds */
    double previousTime;     /**< seconds; only suppleGetRootMotion uses it: the movement from here to time */
    double referenceTime;    /**< ADDITIVE: seconds; 0 is the clip's first pose */
    const float* jointMask;  /**< optional: per joint a value 0..1 that multiplies the weight. Nodes that are no joints
                              * follow the joint above them or, without one, the first joint below */
    uint32_t jointMaskCount; /**< the asset's jointCount; 0 if jointMask is null */
    uint32_t morphMaskCount; /**< the asset's morphTargetCount; 0 if morphMask is null */
    const float* morphMask;  /**< optional: per morph target a value 0..1. Null: 0 if there is a jointMask, else 1 */
} SuppleClipLayer;

/** Sets the entries of mask for joint and every joint below it to value, 0..1. The others stay. mask has jointCount
 * values, as many as the asset has joints. */
SUPPLE_API SuppleResult suppleFillJointMask(SuppleContext context, SuppleAsset asset, uint32_t joint, float value,
                                            float* mask, uint32_t jointCount);

/** Which parts of the root's movement are taken out of the pose, so that they can move the character's transform. Axes
 * are those of model space, where +Y is up. */
typedef enum SuppleRootMotionFlags {
    SUPPLE_ROOT_MOTION_GROUND = 1, /**< translation along x and z */
    SUPPLE_ROOT_MOTION_HEIGHT = 2, /**< translation along y */
    SUPPLE_ROOT_MOTION_YAW = 4     /**< the turn about +Y */
} SuppleRootMotionFlags;

/** Options of a pose. */
typedef enum SupplePoseFlags {
    /** rootJoint is the root. Without this flag, the root is the topmost node that clips move or turn; if there are
     * several, the one above most joints. */
    SUPPLE_POSE_ROOT_JOINT = 1
} SupplePoseFlags;

/** Layers are applied in order to the rest pose. A crossfade is two layers: the old clip with weight 1, then the new
 * one with a weight that rises from 0 to 1. */
typedef struct SupplePoseDesc {
    uint32_t structSize;
    uint32_t flags; /**< SupplePoseFlags */
    const SuppleClipLayer* layers;
    uint32_t layerCount;
    uint32_t rootMotion; /**< SuppleRootMotionFlags: taken out of every layer's clip. In these parts the root stays
                          * where the clip starts */
    uint32_t rootJoint;  /**< with SUPPLE_POSE_ROOT_JOINT */
} SupplePoseDesc;

/** Poses an instance of a group with SUPPLE_POSES_SET. The pose stays until it is set again; nothing tells when it is
 * shown, so there are no transitions to it. The CPU samples it in doubles. The arrays are read during the call. Errors:
 * a clip, joint, mask or weight is out of range, a time is not finite. */
SUPPLE_API SuppleResult suppleSetPose(SuppleContext context, SuppleInstance instance, const SupplePoseDesc* pose);

/** A movement of the root: first the turn, then the translation. */
typedef struct SuppleRootMotion {
    uint32_t structSize;
    float translation[3];
    float yaw;           /**< radians about +Y, the shorter way */
    float transform[16]; /**< column-major: turns by yaw, then translates */
} SuppleRootMotion;

/** How far the root moves in `pose`, from every layer's previousTime to its time. It needs no instance: the host passes
 * the result on. If an instance's transform at previousTime was T, set T * out->transform (suppleSetTransform). With
 * the same `pose` in suppleSetPose, the character then moves as the clip alone would move it. The movement continues
 * over the ends of looping clips. BLEND layers blend their movements like their poses, by the mask's value at the root.
 * ADDITIVE layers add theirs. */
SUPPLE_API SuppleResult suppleGetRootMotion(SuppleContext context, SuppleAsset asset, const SupplePoseDesc* pose,
                                            SuppleRootMotion* out);

/** Fills out: the sharpness that a clip gives to a crease set (suppleGetCreaseSets) at a time, for suppleSetSharpness;
 * before its first and behind its last key what these say, and never less than SUPPLE_LEAST_SHARPNESS. A clip without a
 * curve of the set has SUPPLE_FILE_SHARPNESS, which keys cannot say.
 * Supple does not set it by itself: only the host knows how clips that it plays at the same time go together.
 * docs/gltf.md says how files have curves. Errors: no such clip or set; time is not finite. */
SUPPLE_API SuppleResult suppleGetClipSharpness(SuppleContext context, SuppleAsset asset, uint32_t clip, uint32_t set,
                                               double time, float* out);

/* --------------------------------------------------------------------------------------------------- contacts */

/** A time in which a foot stands in a clip: for sounds and prints of steps, and what SUPPLE_MODIFIER_PLANT holds on to.
 * docs/playback.md says when a foot stands. */
typedef struct SuppleClipContact {
    uint32_t joint;    /**< of the foot */
    double begin;      /**< seconds, within the clip. A contact that spans the end of a loop is two */
    double end;        /**< seconds */
    float position[3]; /**< model space: the ground below the joint at `begin`, without root motion taken out */
    float velocity[3]; /**< a second: how the ground moves, where the character walks in place */
} SuppleClipContact;

/** Fills out and count: the contacts of a clip, by rising begin. The first call for an asset looks for those of all
 * clips, which takes some milliseconds. Errors: no such clip. */
SUPPLE_API SuppleResult suppleGetClipContacts(SuppleContext context, SuppleAsset asset, uint32_t clip,
                                              SuppleClipContact* out, uint32_t* count);

/* ---------------------------------------------------------------------------------------------------- markers */

/** A named time of a clip: a footstep, the moment a blade hits. docs/gltf.md says how files name them. */
typedef struct SuppleClipMarker {
    const char* name; /**< lives as long as the asset; may be empty, and several markers may have one name */
    double time;      /**< seconds */
} SuppleClipMarker;

/** Options of suppleGetClipMarkersBetween. */
typedef enum SuppleMarkerFlags {
    /** The clip loops: time 2.5 is the middle of the third pass of a clip of one second. Without it, nothing lies
     * before 0 or behind the clip's end. A clip of no duration does not loop. */
    SUPPLE_MARKERS_LOOP = 1,
    /** Playback begins at `from`, so markers at `from` count too. Set it for the first interval after playback starts
     * or jumps. With LOOP, if one pass ends and the next begins at `from`, markers at the end of the earlier
     * pass are left out. */
    SUPPLE_MARKERS_START = 2
} SuppleMarkerFlags;

/** Fills out and count: the markers of a clip, by rising time, from 0 to the clip's duration. Errors: no such clip. */
SUPPLE_API SuppleResult suppleGetClipMarkers(SuppleContext context, SuppleAsset asset, uint32_t clip,
                                             SuppleClipMarker* out, uint32_t* count);
/** Fills out and count: the markers that playback passes on its way from one time of a clip to another. Those with from
 * < time <= to, by rising time. Backwards (to < from) those with to <= time < from, by falling time. flags is a
 * combination of SuppleMarkerFlags. Times are unwrapped, as a game counts them, also in `out`: with LOOP, a marker
 * occurs once in every pass. At the end of a pass, markers at the duration and those at 0 of the next pass have the
 * same time. Layers, weights and masks make no difference. If the result is SUPPLE_INCOMPLETE, call again with more
 * room, and with the same times.
 *
 * A host that passes the last call's `to` as `from` gets every marker exactly once: also if it turns round, because a
 * marker counts when playback arrives at it. SUPPLE_MARKERS_START gives those at the very start:
 *
 *     suppleGetClipMarkersBetween(context, asset, clip, last, now, SUPPLE_MARKERS_LOOP |
 *                                 (justStarted ? SUPPLE_MARKERS_START : 0), markers, &count);
 *
 * Errors: no such clip, unknown flags, a time beyond plus or minus SUPPLE_MAX_TIME. */
SUPPLE_API SuppleResult suppleGetClipMarkersBetween(SuppleContext context, SuppleAsset asset, uint32_t clip,
                                                    double from, double to, uint32_t flags, SuppleClipMarker* out,
                                                    uint32_t* count);

/* ---------------------------------------------------------------------------------------------------- streaming */

/** What a host wants of a stretch of a clip. */
typedef enum SuppleClipUse {
    /** It is played soon: its segments are brought to the device. They go again when segments that were asked for later
     * need the room. */
    SUPPLE_CLIP_REQUEST = 0,
    SUPPLE_CLIP_PIN = 1,     /**< the same, and they stay until they are released or merely requested */
    SUPPLE_CLIP_RELEASE = 2, /**< they go first when room is needed; what is on its way is given up */
    SUPPLE_CLIP_USE_MAX_ENUM = 0x7FFFFFFF
} SuppleClipUse;

/** A stretch of a clip, and what is wanted of it. */
typedef struct SuppleClipRequest {
    uint32_t structSize;
    SuppleClipUse use; /**< 0: its segments are brought to the device */
    double begin;      /**< seconds into the clip: the segments from the one that has this time */
    double end; /**< to the one that has this time; 0: to the clip's end. What lies beyond the clip does not count */
} SuppleClipRequest;

/** Asks for segments of a clip, of an asset with a pool (SuppleAssetDesc.clipPoolBytes). Until a segment is there, its
 * times play the clip's coarse twin. A segment has 32 frames, at most 1.4 seconds of most clips. Of clips without a
 * twin, and of assets without a pool, all is there already, and the call does nothing.
 *
 * request: null asks for the whole clip. Asking again for what is there only makes it newer: a game may do so whenever
 * a clip starts. Whoever goes on through a long clip asks for a few seconds ahead. A stretch does not go on at the
 * clip's beginning: at the seam of a loop, ask for both ends.
 *
 * What has been asked for before the asset's first group that plays is created is there from the beginning. Later
 * segments go up with the frames that record groups of the asset or call suppleRecordUploads, those that were asked for
 * first before others: in each frame at most half of the upload budget that suppleBeginFrame finds
 * (suppleSetUploadBudget), without a budget 64 KiB, and 16 bytes for each segment that comes or goes. These bytes count
 * in SuppleUploadState.frameBytes of suppleGetUploadState, but not in those of assets and groups. Segments play from
 * the next suppleBeginFrame on. suppleGetClipInfo tells what is there, getters of joints have the bits of what plays.
 * suppleReloadAsset asks for the same of clips of the same name.
 *
 * If there is no room for a segment, because all that is there is pinned or was asked for later, it waits for some.
 * What is pinned always finds room. Segments move within the pool if what is free lies in pieces that are too small:
 * they play on meanwhile, unless the budget of a frame has no room for one of them; then its twin plays until it is
 * there again.
 *
 * For one thread, as what creates assets is. Errors: no such clip or use; begin or end negative, not finite, or begin
 * behind end; SUPPLE_ERROR_LIMIT: more is pinned than the pool has. */
SUPPLE_API SuppleResult suppleRequestClip(SuppleContext context, SuppleAsset asset, uint32_t clip,
                                          const SuppleClipRequest* request);

/* ---------------------------------------------------------------------------------------------------- playback */

/** One clip that an instance plays. T is the group's time (suppleSetTime). The clip's time is
 * offset + speed * (T - startTime). Without a fade, the layer's weight is `weight`. With a fade, it is `weight` until T
 * is fadeStart, then goes linearly to fadeWeight during fadeDuration, and stays there. At every T the layer acts as a
 * SuppleClipLayer of that time and weight. */
typedef struct SupplePlaybackLayer {
    uint32_t clip;
    uint32_t flags;       /**< SuppleLayerFlags */
    SuppleLayerMode mode; /**< as in SuppleClipLayer */
    uint32_t mask;        /**< number of one of the group's masks (suppleSetMask); 0: none */
    float weight;         /**< with a fade: before it. At a T where its weight is 0 the layer does nothing */
    float fadeWeight;     /**< with a fade: where it ends */
    float fadeDuration;   /**< seconds; 0: no fade */
    float speed;          /**< seconds of the clip per second of T, -1000..1000; 0: the clip stands at offset */
    double startTime;     /**< T at which the clip is at offset */
    double offset;        /**< seconds of the clip */
    double fadeStart;     /**< T at which the fade starts */
    double referenceTime; /**< ADDITIVE: seconds; 0 is the clip's first pose */
} SupplePlaybackLayer;

/** Options of playback. */
typedef enum SupplePlaybackFlags {
    SUPPLE_PLAYBACK_ROOT_JOINT = 1, /**< as SUPPLE_POSE_ROOT_JOINT */
    /** What rootMotion takes out of the first layer's clip moves the instance. It is placed by X * M: X is its
     * transform (suppleSetTransform), M is the movement since the layer's startTime, which continues over the ends of a
     * looping clip. The layer's mode, weight and mask make no difference. */
    SUPPLE_PLAYBACK_TRAVEL = 2,
    /** The transition that the instance is in goes on. Set it to change a speed or a weight of what plays. */
    SUPPLE_PLAYBACK_KEEP_TRANSITION = 4,
    /** The transition starts from what the instance's modifiers have left, not from what its layers have posed: for a
     * body that gets up. Take the modifiers away after this call. Speeds are found with the modifiers' present
     * targets. */
    SUPPLE_PLAYBACK_FROM_MODIFIED = 8
} SupplePlaybackFlags;

/** How an instance goes over from what it has shown to what it plays now. Only the new clips are sampled meanwhile. A
 * crossfade is no kind of it: it is two layers that fade (SupplePlaybackLayer::fadeWeight). */
typedef enum SuppleTransitionKind {
    /** What was shown moves on, ever more slowly: by what it would move in 0.072 s at its speed, and by 30 degrees, at
     * most. What is played is blended in. So joints stay between the two poses, or near (Holden, Dead Blending, 2023).
     */
    SUPPLE_TRANSITION_DEAD_BLENDING = 0,
    /** The difference between the two poses, and between their speeds, goes smoothly to zero. The pose follows the new
     * clip's rhythm sooner, but joints may bend where neither clip goes, by 10 degrees at most from the difference of
     * speeds (Bollo, Inertialization, 2018). */
    SUPPLE_TRANSITION_QUINTIC = 1,
    SUPPLE_TRANSITION_MAX_ENUM = 0x7FFFFFFF
} SuppleTransitionKind;

/** What an instance plays. Layers are applied in order to the rest pose, as in SupplePoseDesc. */
typedef struct SupplePlaybackDesc {
    uint32_t structSize;
    uint32_t flags; /**< SupplePlaybackFlags */
    const SupplePlaybackLayer* layers;
    uint32_t layerCount; /**< at most SUPPLE_MAX_PLAYBACK_LAYERS */
    uint32_t rootMotion; /**< SuppleRootMotionFlags: what is taken out of every layer's clip */
    uint32_t rootJoint;
    double transition; /**< seconds from T at the call on, in which the instance goes over from what it has shown; 0:
                        * none. Groups with SUPPLE_GROUP_TRANSITIONS. 0.3 suits most changes */
    SuppleTransitionKind transitionKind; /**< how */
    /** Groups with SUPPLE_GROUP_UPDATE_RATES: steps of 1/60 s from pose to pose: 2, 4 or 8; 1: it is posed in every
     * frame; 0: as the size on the screen allows in the view that the group belongs to, and 1 without a view. */
    uint32_t updateInterval;
} SupplePlaybackDesc;

/** Groups with SUPPLE_POSES_PLAYBACK: sets what an instance plays from the next suppleRecord on, until it is set again.
 * The array is read during the call. The device then computes poses from the group's time alone. In a frame in which
 * no playback and no new origin is set, none is uploaded, and the CPU's work is the same for any number of instances;
 * but in a view that culls, it looks for those that are out of sight (SUPPLE_VIEW_CULL), and with update rates for
 * those whose turn it is.
 * Such groups also take suppleSetTransform and suppleSetMorphWeights. Poses agree with those of suppleSetPose except
 * for rounding (docs/playback.md).
 * A transition is a function of T. It starts at the T that the group has at the call, so set the time first. If another
 * transition is running, it starts from what that one shows, and replaces it. At a T before its start there is none. It
 * changes local transforms, after layers and root motion and before modifiers, and morph weights unless the host has
 * set some. It ends if the playback is set again without KEEP_TRANSITION. An instance in the bind pose begins at once.
 * With an updateInterval of N, the instance in a slot is posed for the times (k N - slot mod N) / 60 s, ahead of T, and
 * its joint palette goes straight from one to the next: it does not lag, and it depends on T alone. It is posed
 * exactly, in every frame, while it is in a transition, has modifiers, has a layer that fades, or passes the beginning
 * or end of a clip, or the seam of a loop that does not end as it begins. A call poses it twice in the next frame.
 * Errors: the group has another pose source; too many layers; a clip, joint, mode, flag or kind of transition that does
 * not exist; a mask that was not set; a weight, speed, fade, transition or time out of range or not finite; TRAVEL
 * without rootMotion; a transition without SUPPLE_GROUP_TRANSITIONS, or with KEEP_TRANSITION; FROM_MODIFIED without a
 * transition; an updateInterval that is none of these, or without SUPPLE_GROUP_UPDATE_RATES. */
SUPPLE_API SuppleResult suppleSetPlayback(SuppleContext context, SuppleInstance instance,
                                          const SupplePlaybackDesc* playback);
/** Sets T, the time in seconds by which all instances of a group with SUPPLE_POSES_PLAYBACK play; 0 at first. It may
 * rise or fall by any amount within SUPPLE_MAX_TIME. Errors: the group has another pose source; the time is beyond
 * plus or minus SUPPLE_MAX_TIME or not finite. */
SUPPLE_API SuppleResult suppleSetTime(SuppleContext context, SuppleGroup group, double seconds);

/** A mask for the layers of a group's instances. */
typedef struct SuppleMaskDesc {
    uint32_t structSize;
    uint32_t mask;          /**< its number, 1..SUPPLE_MAX_MASKS */
    const float* jointMask; /**< as in SuppleClipLayer, copied; null only if morphMask is not */
    const float* morphMask; /**< as in SuppleClipLayer, copied; null only if jointMask is not */
    uint32_t jointMaskCount;
    uint32_t morphMaskCount;
} SuppleMaskDesc;
/** Sets one of the masks of a group with SUPPLE_POSES_PLAYBACK. Set a mask before a layer names it. If you set it
 * again, the layers that name it use the new values. Errors: the group has another pose source; no such mask; both
 * pointers are null; a count is not the asset's; a value is outside of 0..1. */
SUPPLE_API SuppleResult suppleSetMask(SuppleContext context, SuppleGroup group, const SuppleMaskDesc* mask);

/* ---------------------------------------------------------------------------------------------------- matrices */

/** Matrices of joints, or of some joints. */
typedef struct SuppleJointMatricesDesc {
    uint32_t structSize;
    uint32_t jointCount;        /**< how many matrices; without `joints`, as many as the asset has joints */
    const float* jointMatrices; /**< column-major, in model space: as suppleSetMatrixPose takes them */
    const uint32_t* joints; /**< optional: the joints that the matrices are of, each once. The others stay as they are
                             * posed, also those below */
    const float*
        morphWeights; /**< optional: those of the pose, instead of the rest pose's. Null with `joints`: they stay */
    uint32_t morphTargetCount; /**< the asset's morphTargetCount; 0 if morphWeights is null */
} SuppleJointMatricesDesc;
/** As suppleSetMatrixPose, for some joints and with morph weights: for a ragdoll that moves a limb of what plays, or
 * for an animation system that knows of morph targets. Arrays are read during the call. Weights of
 * suppleSetMorphWeights stand before those of the pose. Errors: as of suppleSetMatrixPose; a joint that does not exist
 * or comes twice; a weight that is not finite. */
SUPPLE_API SuppleResult suppleSetJointMatrices(SuppleContext context, SuppleInstance instance,
                                               const SuppleJointMatricesDesc* matrices);

/* ---------------------------------------------------------------------------------------------------- modifiers */

#define SUPPLE_MAX_MODIFIERS 16u /**< per instance: see suppleSetModifiers */
#define SUPPLE_MAX_AIM_JOINTS 8u /**< see SuppleModifier.chainLength */

/** What a modifier does.
 * SET: the joint has `rotation`.
 * ADD: the joint turns by `rotation`, in its own frame behind the clips' rotation.
 * AIM: the joint turns so that the ray from its eye along its forward axis passes the target, and joints above it help.
 * If the target is behind, it gives up: the weight fades while the angle between the ray in the clips' pose and the
 * target goes from 120 to 160 degrees. If the target lies so close to a joint that no turn of it reaches, the joint
 * stays. TWO_BONE: the joint is the end of a limb, a hand or a foot. Its two bones turn so that it comes to the target.
 * What is out of reach pulls the limb nearly straight. The end keeps its rotation in model space. HAND_OVER: the joint
 * stands at the target and has `rotation`, both in model space: what another simulation, a ragdoll say, makes of it.
 * What hangs on it follows.
 * PLANT: the joint is a foot, and stands on the ground: the plane through the target whose normal is +Y turned by
 * `rotation`. Its limb is bent as by TWO_BONE. It goes up or down by what the ground under it differs from the plane
 * under the foot's sole in the rest pose, and tilts with the ground. While a clip has it on the ground, it stays in one
 * place there: those times are found when the file is loaded (docs/playback.md). PLANT keeps no state: seeking and
 * replay give the same pose.
 * LOWER: the joint, the hips, moves down in model space until every foot below it with a later PLANT reaches its
 * ground. */
typedef enum SuppleModifierKind {
    SUPPLE_MODIFIER_SET = 0,
    SUPPLE_MODIFIER_ADD = 1,
    SUPPLE_MODIFIER_AIM = 2,
    SUPPLE_MODIFIER_TWO_BONE = 3,
    SUPPLE_MODIFIER_HAND_OVER = 4,
    SUPPLE_MODIFIER_PLANT = 5,
    SUPPLE_MODIFIER_LOWER = 6,
    SUPPLE_MODIFIER_MAX_ENUM = 0x7FFFFFFF
} SuppleModifierKind;

/** Options of a modifier. */
typedef enum SuppleModifierFlags {
    SUPPLE_MODIFIER_WORLD = 1, /**< AIM, TWO_BONE, HAND_OVER, PLANT: target and pole are points of the world, not of
                                * model space; of PLANT also the ground's normal */
    SUPPLE_MODIFIER_POLE = 2,  /**< TWO_BONE, PLANT: the middle joint, a knee or an elbow, points towards the pole */
    SUPPLE_MODIFIER_END_ROTATION = 4, /**< TWO_BONE: the end has `rotation` in model space */
    SUPPLE_MODIFIER_MODEL = 8 /**< SET, ADD: rotation is in model space, not in the frame of the joint's parent */
} SuppleModifierFlags;

/** A change of the pose behind the clips. Model space is that of the character, before the instance's transform; with
 * root motion, it is where the clips have the character after what was taken out. Zeros of members that are not needed
 * are fine. */
typedef struct SuppleModifier {
    SuppleModifierKind kind;
    uint32_t flags; /**< SuppleModifierFlags */
    uint32_t joint; /**< TWO_BONE, PLANT: the end. The joint above it is the middle, the next one the root; joints whose
                     * names differ from the next one's above in digits alone are parts of one bone */
    uint32_t chainLength; /**< AIM: joints that turn, from `joint` upwards, 1..SUPPLE_MAX_AIM_JOINTS; 0 = 1 */
    float weight;         /**< 0..1. 0: the pose keeps its bits. TWO_BONE, HAND_OVER, PLANT, LOWER: how far the joint
                           * goes towards where it shall be; else the part of the turn */
    float fadeWeight;     /**< as in SupplePlaybackLayer */
    float fadeDuration;   /**< seconds; 0: no fade */
    float share;          /**< AIM: part of what is still missing that each joint above `joint` takes, 0..1 */
    double fadeStart;     /**< the group's time at which the fade starts */
    double target[3];     /**< a point of model space or of the world */
    double pole[3];       /**< with POLE: the same */
    float rotation[4];    /**< x, y, z, w; of any length but 0, if it is needed. PLANT: takes +Y to the ground's normal;
                           * zeros: the ground is level */
    float axis[3];        /**< AIM: forward in the joint's frame; zeros: +Z of model space in the rest pose. TWO_BONE,
                           * PLANT: the axis in the middle joint's frame about which a straight limb bends; zeros: as in the
                           * rest pose */
    float offset[3];      /**< AIM: the eye, in the joint's frame */
    float limit; /**< AIM: radians that each joint turns at most; 0: any. PLANT: radians that the foot tilts at most;
                  * 0 = 0.52. LOWER: how far the joint goes down at most; 0: 0.3 of the longest leg */
    float soft;  /**< TWO_BONE, PLANT: from this part of its length on, the limb follows ever more slowly, so that it is
                  * never quite straight: 0.5..0.999; 0 = 0.97 */
    float poleWeight; /**< with POLE: 0..1 */
} SuppleModifier;

/** The modifiers of an instance. */
typedef struct SuppleModifiersDesc {
    uint32_t structSize;
    uint32_t modifierCount; /**< at most SUPPLE_MAX_MODIFIERS; 0: none */
    const SuppleModifier* modifiers;
} SuppleModifiersDesc;

/** Groups with SUPPLE_GROUP_MODIFIERS: replaces the instance's list of modifiers. They stay, whatever pose the instance
 * has, but do nothing in the bind pose and in poses of matrices. They are executed in order, each on what the one
 * before left, after the layers and root motion and before skinning: with SUPPLE_POSES_PLAYBACK on the device, else on
 * the CPU, where weights do not fade. suppleGetJointTransform has what they do, to the bit. Turns are exact if no joint
 * above scales unevenly or mirrors. With PLAYBACK, a group of which no instance has ever had one records no pass for
 * them. A view that culls leaves out instances before they are posed only if all that their modifiers turn moves in
 * some clip, or hangs on what does, and none is HAND_OVER. The array is read during the call. Errors: the group has not
 * the flag; too many; a kind, flag or joint that does not exist; PLANT of a joint that is no foot; a chain that is
 * longer than the skeleton, or has a joint with a fixed matrix; a number out of range or not finite; a rotation of
 * length 0; a fade, without PLAYBACK. */
SUPPLE_API SuppleResult suppleSetModifiers(SuppleContext context, SuppleInstance instance,
                                           const SuppleModifiersDesc* modifiers);

/** What of a modifier may change every frame. */
typedef struct SuppleModifierTarget {
    uint32_t structSize;
    float weight;     /**< a fade ends */
    double target[3]; /**< these three as in SuppleModifier */
    double pole[3];
    float rotation[4];
} SuppleModifierTarget;
/** Replaces the target, pole, rotation and weight of the instance's modifier `index`; all else stays. Errors: as of
 * suppleSetModifiers; the instance has no modifier `index`. */
SUPPLE_API SuppleResult suppleSetModifierTarget(SuppleContext context, SuppleInstance instance, uint32_t index,
                                                const SuppleModifierTarget* target);

#ifdef __cplusplus
}
#endif
#endif
