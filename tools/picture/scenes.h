// scenes.h - the scenes of the gallery, each built with the public calls alone.
#ifndef PICTURE_SCENES_H
#define PICTURE_SCENES_H
#include "picture.h"

typedef struct picture_scene {
    const char *name, *title, *caption;
    int32_t width, height; ///< of its picture in the gallery
    int32_t step;          ///< of 1/60 s, at which it is taken
    picture_view view;
    void (*build)(fe_world *world);
} picture_scene;

extern const picture_scene picture_scenes[];
extern const int32_t picture_scene_count;

/// The world of a scene after some steps.
/// @param def  NULL: the defaults
fe_world *picture_play(const picture_scene *scene, const fe_world_def *def, int32_t steps);
/// Of the bytes of a small picture of the scene as it begins: no step, so that the solver has no part in it.
uint64_t picture_hash(const picture_scene *scene);

/// Ends the program with a sentence where a call fails.
int32_t picture_must(int32_t result);

#endif
