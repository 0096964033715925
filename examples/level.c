// level.c - loads a level from files of OBJ, glTF, FBX and what else the library assimp reads, and plays it.
//
//     cc level.c -lfeather -lassimp -lm -o level && ./level models/yard.obj models/yard.gltf
//
// Each mesh of a node is a triangle mesh of a static body. A node whose name ends in "-rigid", as in Godot's import, is
// a dynamic body instead: the convex hull of its points. Says what Feather found in the triangles, since models are
// seldom as closed as they look, and where the bodies lie after five seconds.
#include "feather.h"

#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DT (1.0f / 60)
enum { STEPS = 300, MOST_BODIES = 1024 };

typedef struct level {
    fe_world *world;
    fe_store *store;
    fe_body bodies[MOST_BODIES]; // that move
    int32_t count;
} level;

static int32_t must(int32_t result)
{
    if (result >= 0) return result;
    printf("%s\n", fe_last_error());
    exit(1);
}

// The vertices of a mesh about the middle of their bounds, in axes of the level, m
static float (*place(const struct aiMesh *mesh, const struct aiMatrix4x4 *frame, float middle[3]))[3]
{
    float(*places)[3] = malloc(mesh->mNumVertices * sizeof *places), lower[3], upper[3];
    if (!places) exit(1);
    for (unsigned i = 0; i < mesh->mNumVertices; ++i) {
        struct aiVector3D at = mesh->mVertices[i];
        aiTransformVecByMatrix4(&at, frame);
        places[i][0] = at.x, places[i][1] = at.y, places[i][2] = at.z;
        for (int k = 0; k < 3; ++k) {
            if (i == 0 || places[i][k] < lower[k]) lower[k] = places[i][k];
            if (i == 0 || places[i][k] > upper[k]) upper[k] = places[i][k];
        }
    }
    for (int k = 0; k < 3; ++k) {
        middle[k] = 0.5f * (lower[k] + upper[k]);
        for (unsigned i = 0; i < mesh->mNumVertices; ++i) places[i][k] -= middle[k];
    }
    return places;
}

static fe_asset make_hull(fe_store *store, const struct aiMesh *mesh, const float (*places)[3])
{
    fe_hull_def def;
    fe_hull_def_init(&def, sizeof def);
    def.points = places[0], def.point_count = (int32_t)mesh->mNumVertices;
    fe_asset hull;
    must(fe_hull_create(store, &def, &hull));
    return hull;
}

// All faces are triangles: aiProcess_Triangulate, aiProcess_SortByPType
static fe_asset make_mesh(fe_store *store, const struct aiMesh *mesh, const float (*places)[3])
{
    uint32_t(*triangles)[3] = malloc(mesh->mNumFaces * sizeof *triangles);
    if (!triangles) exit(1);
    for (unsigned i = 0; i < mesh->mNumFaces; ++i) {
        for (int k = 0; k < 3; ++k) triangles[i][k] = mesh->mFaces[i].mIndices[k];
    }
    fe_mesh_def def;
    fe_mesh_def_init(&def, sizeof def);
    def.vertices = places[0], def.vertex_count = (int32_t)mesh->mNumVertices;
    def.indices = triangles, def.triangle_count = (int32_t)mesh->mNumFaces;
    fe_asset made;
    must(fe_mesh_create(store, &def, &made));
    free(triangles);
    fe_mesh_info info;
    fe_mesh_info_init(&info, sizeof info);
    must(fe_mesh_get_info(store, made, &info));
    printf("%s: %d triangles, %d vertices, %d open edges, %d flipped edges\n", mesh->mName.data, info.triangle_count,
           info.vertex_count, info.open_edges, info.flipped_edges);
    return made;
}

static void add_mesh(level *to, const struct aiMesh *mesh, const struct aiMatrix4x4 *frame, int is_rigid)
{
    if (mesh->mPrimitiveTypes != aiPrimitiveType_TRIANGLE) return;
    float middle[3], (*places)[3] = place(mesh, frame, middle);
    fe_geometry form;
    if (is_rigid)
        fe_geometry_hull(&form, make_hull(to->store, mesh, (const float(*)[3])places));
    else
        fe_geometry_mesh(&form, make_mesh(to->store, mesh, (const float(*)[3])places));
    free(places);
    fe_body_def def;
    fe_body_def_init(&def, sizeof def);
    def.type = is_rigid ? FE_BODY_DYNAMIC : FE_BODY_STATIC;
    def.transform = fe_make_transform(middle[0], middle[1], middle[2]);
    fe_body body;
    fe_shape shape;
    must(fe_body_create(to->world, &def, &body));
    must(fe_shape_create(to->world, body, NULL, &form, &shape));
    if (is_rigid && to->count < MOST_BODIES) to->bodies[to->count++] = body;
}

static int ends_with(const char *name, const char *end)
{
    size_t length = strlen(name), tail = strlen(end);
    return length >= tail && strcmp(name + length - tail, end) == 0;
}

static void add_node(level *to, const struct aiScene *scene, const struct aiNode *node, struct aiMatrix4x4 frame)
{
    aiMultiplyMatrix4(&frame, &node->mTransformation);
    for (unsigned i = 0; i < node->mNumMeshes; ++i)
        add_mesh(to, scene->mMeshes[node->mMeshes[i]], &frame, ends_with(node->mName.data, "-rigid"));
    for (unsigned i = 0; i < node->mNumChildren; ++i) add_node(to, scene, node->mChildren[i], frame);
}

static int play(const char *path)
{
    unsigned steps = aiProcess_Triangulate | aiProcess_SortByPType;
    const struct aiScene *scene = aiImportFile(path, steps);
    if (!scene) {
        printf("%s: %s\n", path, aiGetErrorString());
        return 1;
    }
    static level of;
    of.count = 0;
    must(fe_world_create(NULL, &of.world));
    must(fe_world_get_store(of.world, &of.store));
    struct aiMatrix4x4 frame;
    aiIdentityMatrix4(&frame);
    add_node(&of, scene, scene->mRootNode, frame);
    aiReleaseImport(scene);
    for (int i = 0; i < STEPS; ++i) must(fe_world_step(of.world, DT));
    for (int32_t i = 0; i < of.count; ++i) {
        fe_transform at;
        must(fe_body_get_transform(of.world, of.bodies[i], &at));
        printf("body %d lies at %.2f %.2f %.2f\n", i + 1, at.position.x, at.position.y, at.position.z);
    }
    must(fe_world_destroy(of.world));
    return 0;
}

int main(int count, char **arguments)
{
    if (count < 2) printf("level FILE...\n");
    for (int i = 1; i < count; ++i) {
        printf("%s\n", arguments[i]);
        if (play(arguments[i])) return 1;
    }
    return count < 2;
}
