#define _GNU_SOURCE
#include "sealed_frames_counter.h"

#include <errno.h>
#include <stdarg.h>
#include <stddef.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

/* The allocator of the C library under its other names. */
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *old, size_t size);
void *__libc_memalign(size_t alignment, size_t size);
void __libc_free(void *memory);

static unsigned long allocated, freed;

unsigned long allocations(void) { return __atomic_load_n(&allocated, __ATOMIC_SEQ_CST); }
unsigned long frees(void) { return __atomic_load_n(&freed, __ATOMIC_SEQ_CST); }

static void count(unsigned long *counter) { __atomic_fetch_add(counter, 1, __ATOMIC_SEQ_CST); }

void *malloc(size_t size)
{
    count(&allocated);
    return __libc_malloc(size);
}

void *calloc(size_t n, size_t size)
{
    count(&allocated);
    return __libc_calloc(n, size);
}

void *realloc(void *old, size_t size)
{
    count(&allocated);
    return __libc_realloc(old, size);
}

void *reallocarray(void *old, size_t n, size_t size)
{
    if (size != 0 && n > (size_t)-1 / size) {
        errno = ENOMEM;
        return NULL;
    }
    return realloc(old, n * size);
}

void *memalign(size_t alignment, size_t size)
{
    count(&allocated);
    return __libc_memalign(alignment, size);
}

void *aligned_alloc(size_t alignment, size_t size) { return memalign(alignment, size); }
void *valloc(size_t size) { return memalign((size_t)sysconf(_SC_PAGESIZE), size); }

int posix_memalign(void **memory, size_t alignment, size_t size)
{
    *memory = memalign(alignment, size);
    return *memory == NULL ? ENOMEM : 0;
}

void free(void *memory)
{
    if (memory != NULL) {
        count(&freed);
        __libc_free(memory);
    }
}

void *mmap(void *address, size_t length, int protection, int flags, int file, off_t offset)
{
    count(&allocated);
    return (void *)syscall(SYS_mmap, address, length, protection, flags, file, offset);
}

void *mmap64(void *address, size_t length, int protection, int flags, int file, off64_t offset)
{
    count(&allocated);
    return (void *)syscall(SYS_mmap, address, length, protection, flags, file, offset);
}

void *mremap(void *old, size_t old_size, size_t new_size, int flags, ...)
{
    va_list rest;
    void *address = NULL;
    va_start(rest, flags);
    if (flags & MREMAP_FIXED) {
        address = va_arg(rest, void *);
    }
    va_end(rest);
    count(&allocated);
    return (void *)syscall(SYS_mremap, old, old_size, new_size, flags, address);
}

int munmap(void *address, size_t length)
{
    count(&freed);
    return (int)syscall(SYS_munmap, address, length);
}
