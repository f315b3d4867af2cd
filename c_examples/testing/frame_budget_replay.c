#include "frame_budget_replay.h"

#include "docking_scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void refuse(const char *file, const char *why)
{
    fprintf(stderr, "%s: %s\n", file, why);
    exit(2);
}

static void *memory(size_t size)
{
    void *made = malloc(size);
    if (made == NULL) {
        fprintf(stderr, "out of memory\n");
        exit(3);
    }
    memset(made, 0, size);
    return made;
}

typedef struct {
    const char *name;
    FILE *stream;
    pong_model_id models[MOST_MODELS];
    size_t model_count;
} source;

static void add_model(source *s, replay *r, const char *file)
{
    if (s->model_count == MOST_MODELS) {
        refuse(s->name, "more models than there is room for");
    }
    CHECK(pong_load_model(r->world, file, &s->models[s->model_count++]));
}

static void add_object(source *s, replay *r, const char *model, const char *name)
{
    size_t number = (size_t)strtoul(model, NULL, 10);
    pong_object_id object;
    if (number >= s->model_count) {
        refuse(s->name, "an object has a model that is not there");
    }
    CHECK(pong_create_object(r->world, s->models[number], name, &object));
}

static void add_group(source *s, replay *r, const char *object, const char *path)
{
    pong_object_id id;
    if (r->group_count == MOST_GROUPS) {
        refuse(s->name, "more movable groups than there is room for");
    }
    CHECK(pong_find_object(r->world, object, &id));
    CHECK(pong_find_interface(r->world, id, path, &r->groups[r->group_count++]));
}

/* Every line up to the one that counts the frames. */
static void read_scene(source *s, replay *r)
{
    char line[2048], word[16], a[1024], b[1024];
    while (fgets(line, sizeof line, s->stream) != NULL) {
        int words = sscanf(line, "%15s %1023s %1023s", word, a, b);
        if (words == 2 && strcmp(word, "model") == 0) {
            add_model(s, r, a);
        } else if (words == 3 && strcmp(word, "object") == 0) {
            add_object(s, r, a, b);
        } else if (words == 3 && strcmp(word, "pair") == 0) {
            CHECK(pong_pair_by_name(r->world, a, b, NULL));
        } else if (words == 3 && strcmp(word, "group") == 0) {
            add_group(s, r, a, b);
        } else if (words == 2 && strcmp(word, "frames") == 0) {
            r->frames = (size_t)strtoul(a, NULL, 10);
            return;
        } else {
            refuse(s->name, "a line that cannot be read");
        }
    }
    refuse(s->name, "no frames");
}

static void read_states(source *s, replay *r)
{
    size_t count = r->frames * r->group_count;
    if (count == 0) {
        refuse(s->name, "no states");
    }
    r->states = memory(count * sizeof *r->states);
    if (fread(r->states, sizeof *r->states, count, s->stream) != count) {
        refuse(s->name, "ends before its last frame");
    }
}

void open_replay(replay *r, const char *file, pong_config config)
{
    source s;
    unsigned long capacity;
    memset(r, 0, sizeof *r);
    memset(&s, 0, sizeof s);
    s.name = file;
    s.stream = fopen(file, "rb");
    if (s.stream == NULL || fscanf(s.stream, "capacity %lu\n", &capacity) != 1) {
        refuse(file, "cannot be read");
    }
    config.contact_capacity = capacity;
    CHECK(PONG_CHECK_ABI());
    CHECK(pong_create_world(&config, &r->world));
    read_scene(&s, r);
    read_states(&s, r);
    fclose(s.stream);
    CHECK(pong_seal(r->world, NULL));
    CHECK(pong_worker_count(r->world, &r->workers));
    replay_frame(r, 0);
    CHECK(pong_contact_state_used(r->world, &r->begin_size));
    r->begin = memory(r->begin_size);
    CHECK(pong_save_contact_state(r->world, r->begin, r->begin_size));
}

void close_replay(replay *r)
{
    CHECK(pong_destroy_world(r->world));
    free(r->states);
    free(r->begin);
}

void rewind_replay(replay *r)
{
    CHECK(pong_restore_contact_state(r->world, r->begin, r->begin_size));
}

void replay_frame(replay *r, size_t frame)
{
    CHECK(pong_set_states(r->world, r->groups, r->states + frame * r->group_count, r->group_count));
    CHECK(pong_step(r->world));
    CHECK(pong_get_wrenches(r->world, r->groups, PONG_REFERENCE_FRAME_COMMON, r->wrenches, r->group_count));
}
