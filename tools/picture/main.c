// main.c - feather-picture: takes a picture of a scene of its own, or writes the gallery's page.
#include "scenes.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const char usage[] = "feather-picture SCENE FILE.png [--width N] [--height N] [--step N] [--time]\n"
                            "feather-picture --page    the gallery's page, to stdout\n"
                            "feather-picture --list    names of scenes\n"
                            "feather-picture --hash    of small pictures of them, as tests/determinism/pictures.txt\n";

static int fail(const char *what, const char *which)
{
    fprintf(stderr, "feather-picture: %s%s\n%s", what, which, usage);
    return 1;
}

static int write_picture(const picture_scene *scene, const char *path, int timed)
{
    fe_world *world = picture_play(scene, NULL, scene->step);
    size_t size;
    clock_t start = clock();
    uint8_t *png = picture_take(world, &scene->view, scene->width, scene->height, &size);
    if (!png) return fail("no picture: ", fe_last_error());
    if (timed) printf("%.1f ms\n", 1e3 * (double)(clock() - start) / CLOCKS_PER_SEC);
    FILE *file = fopen(path, "wb");
    int written = file && fwrite(png, 1, size, file) == size;
    if (!file || fclose(file) != 0 || !written) return fail("cannot write ", path);
    free(png);
    picture_must(fe_world_destroy(world));
    return 0;
}

// What tests/determinism/pictures.txt holds
static int print_hashes(void)
{
    for (int32_t i = 0; i < picture_scene_count; ++i)
        printf("%s %016" PRIx64 "\n", picture_scenes[i].name, picture_hash(picture_scenes + i));
    return 0;
}

static void write_page(void)
{
    printf(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>Feather: pictures</title>\n"
        "<meta name=\"viewport\" content=\"width=device-width\">\n<style>\n"
        "body { margin: 2em auto; padding: 0 1em; max-width: 800px; font: 16px/1.5 sans-serif; color: #24292f; "
        "background: #fff }\nfigure { margin: 2.5em 0 }\nimg { width: 100%%; height: auto; border-radius: 6px }\n"
        "figcaption { margin-top: .5em }\n@media (prefers-color-scheme: dark) { body { color: #d6dbe1; "
        "background: #15181c } a { color: #79b8ff } }\n</style>\n</head>\n<body>\n<h1>Feather: pictures</h1>\n"
        "<p>Each is a world as it is after some steps, drawn by <code>build/feather-picture</code> from what the "
        "draw calls of <a href=\"../include/feather.h\">feather.h</a> give, without a GPU. <code>make gallery</code> "
        "makes them anew: the same bytes on every machine.</p>\n");
    for (int32_t i = 0; i < picture_scene_count; ++i) {
        const picture_scene *s = picture_scenes + i;
        printf("<figure>\n<img src=\"images/%s.png\" width=\"%d\" height=\"%d\" alt=\"%s\">\n"
               "<figcaption><b>%s.</b> %s</figcaption>\n</figure>\n",
               s->name, (int)s->width, (int)s->height, s->title, s->title, s->caption);
    }
    printf("</body>\n</html>\n");
}

static const picture_scene *find_scene(const char *name)
{
    for (int32_t i = 0; i < picture_scene_count; ++i)
        if (strcmp(picture_scenes[i].name, name) == 0) return picture_scenes + i;
    return NULL;
}

int main(int count, char **arguments)
{
    if (count == 2 && strcmp(arguments[1], "--page") == 0) return write_page(), 0;
    if (count == 2 && strcmp(arguments[1], "--hash") == 0) return print_hashes();
    if (count == 2 && strcmp(arguments[1], "--list") == 0) {
        for (int32_t i = 0; i < picture_scene_count; ++i) printf("%s\n", picture_scenes[i].name);
        return 0;
    }
    if (count < 3) return fail("which scene, and where to?", "");
    const picture_scene *found = find_scene(arguments[1]);
    if (!found) return fail("there is no scene ", arguments[1]);
    picture_scene scene = *found;
    int timed = 0;
    for (int i = 3; i < count; ++i) {
        int32_t *number = strcmp(arguments[i], "--width") == 0    ? &scene.width
                          : strcmp(arguments[i], "--height") == 0 ? &scene.height
                          : strcmp(arguments[i], "--step") == 0   ? &scene.step
                                                                  : NULL;
        if (strcmp(arguments[i], "--time") == 0)
            timed = 1;
        else if (number && i + 1 < count)
            *number = (int32_t)atoi(arguments[++i]);
        else
            return fail("what is ", arguments[i]);
    }
    return write_picture(&scene, arguments[2], timed);
}
