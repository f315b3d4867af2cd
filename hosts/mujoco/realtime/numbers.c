#define _POSIX_C_SOURCE 200809L

#include "numbers.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void refuse(const char *what, const char *why)
{
    fprintf(stderr, "%s: %s\n", what, why);
    exit(2);
}

static char *whole_file(const char *file)
{
    FILE *stream = fopen(file, "rb");
    char *text = malloc(MOST_WORDS * 32);
    size_t size;
    if (stream == NULL || text == NULL) {
        refuse(file, "cannot be read");
    }
    size = fread(text, 1, MOST_WORDS * 32 - 1, stream);
    fclose(stream);
    text[size] = '\0';
    return text;
}

void read_numbers(numbers *n, const char *file)
{
    char *line, *rest, *word, *more;
    int used = 0;
    memset(n, 0, sizeof *n);
    n->text = whole_file(file);
    for (line = strtok_r(n->text, "\n", &rest); line != NULL; line = strtok_r(NULL, "\n", &rest)) {
        if (n->count == MOST_ROWS) {
            refuse(file, "more rows than there is room for");
        }
        n->rows[n->count] = &n->words[used];
        for (word = strtok_r(line, " ", &more); word != NULL; word = strtok_r(NULL, " ", &more)) {
            if (used == MOST_WORDS) {
                refuse(file, "more words than there is room for");
            }
            n->words[used++] = word;
            n->sizes[n->count] += 1;
        }
        n->count += 1;
    }
}

static int find(const numbers *n, const char *name, int which)
{
    int i;
    for (i = 0; i < n->count; i++) {
        if (strcmp(n->rows[i][0], name) == 0 && which-- == 0) {
            return i;
        }
    }
    return -1;
}

char **row_of(const numbers *n, const char *name, int which)
{
    int i = find(n, name, which);
    return i < 0 ? NULL : n->rows[i];
}

double number_at(const numbers *n, const char *name, int index)
{
    int i = find(n, name, 0);
    if (i < 0 || index + 1 >= n->sizes[i]) {
        refuse(name, "a number of this name is missing");
    }
    return strtod(n->rows[i][index + 1], NULL);
}

double number(const numbers *n, const char *name) { return number_at(n, name, 0); }
