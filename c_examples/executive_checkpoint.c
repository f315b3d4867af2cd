#include "executive_checkpoint.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Header before the two contact states. */
typedef struct {
    char kind[16];
    size_t struct_size, fast_bytes, slow_bytes;
    long frame;
    docking dynamics;
    contact_wrenches contact;
    wrench on_cabin;
    motion tool;
    long age;
} head;

static const char KIND[16] = "pong executive 1";

void make_checkpoint(checkpoint *c, const simulation *sim)
{
    size_t fast, slow;
    CHECK(pong_contact_state_size(sim->scene.world, &fast));
    CHECK(pong_contact_state_size(sim->cabin.world, &slow));
    c->capacity = sizeof(head) + fast + slow;
    c->size = 0;
    c->bytes = malloc(c->capacity);
    if (c->bytes == NULL) {
        fprintf(stderr, "out of memory\n");
        exit(3);
    }
    memset(c->bytes, 0, c->capacity);
}

void take_checkpoint(checkpoint *c, const simulation *sim)
{
    static head h; /* its padding is zero: equal runs have equal files */
    memcpy(h.kind, KIND, sizeof h.kind);
    h.struct_size = sizeof h;
    CHECK(pong_contact_state_used(sim->scene.world, &h.fast_bytes));
    CHECK(pong_contact_state_used(sim->cabin.world, &h.slow_bytes));
    h.frame = sim->frame;
    h.dynamics = sim->dynamics;
    h.contact = sim->contact;
    h.on_cabin = sim->on_cabin;
    h.tool = sim->cabin.tool;
    h.age = sim->age;
    memcpy(c->bytes, &h, sizeof h);
    CHECK(pong_save_contact_state(sim->scene.world, c->bytes + sizeof h, h.fast_bytes));
    CHECK(pong_save_contact_state(sim->cabin.world, c->bytes + sizeof h + h.fast_bytes, h.slow_bytes));
    c->size = sizeof h + h.fast_bytes + h.slow_bytes;
}

static void refuse_file(const char *path, const char *why)
{
    fprintf(stderr, "%s: %s\n", path, why);
    exit(2);
}

void write_checkpoint(const checkpoint *c, const char *path)
{
    FILE *file = fopen(path, "wb");
    if (file == NULL || fwrite(c->bytes, 1, c->size, file) != c->size || fclose(file) != 0) {
        refuse_file(path, "the checkpoint cannot be written; is there room, and may the folder be written?");
    }
}

void read_checkpoint(checkpoint *c, const char *path)
{
    FILE *file = fopen(path, "rb");
    head h;
    if (file == NULL) {
        refuse_file(path, "there is no such checkpoint");
    }
    c->size = fread(c->bytes, 1, c->capacity, file);
    fclose(file);
    if (c->size < sizeof h) {
        refuse_file(path, "is too short for a checkpoint");
    }
    memcpy(&h, c->bytes, sizeof h);
    if (memcmp(h.kind, KIND, sizeof h.kind) != 0 || h.struct_size != sizeof h ||
        h.fast_bytes + h.slow_bytes != c->size - sizeof h) {
        refuse_file(path, "is no checkpoint of this program, or is cut off");
    }
}

void restart_from(const checkpoint *c, simulation *sim)
{
    head h;
    memcpy(&h, c->bytes, sizeof h);
    CHECK(pong_restore_contact_state(sim->scene.world, c->bytes + sizeof h, h.fast_bytes));
    CHECK(pong_restore_contact_state(sim->cabin.world, c->bytes + sizeof h + h.fast_bytes, h.slow_bytes));
    sim->frame = h.frame;
    sim->dynamics = h.dynamics;
    sim->contact = h.contact;
    sim->on_cabin = h.on_cabin;
    /* The slow world rests at a checkpoint: what it computed last is what acts. */
    sim->cabin.on_cabin = h.on_cabin;
    sim->cabin.tool = h.tool;
    sim->age = (int)h.age;
}
