// forest.c - which trees are alike, so that they may be solved side by side.
#include "solver/tree/forest.h"

static uint64_t mixed(uint64_t form, uint64_t value)
{
    const uint64_t odd = 0x9e3779b97f4a7c15u; // 2^64 over the golden ratio
    form = (form ^ value) * odd;
    return form ^ form >> 29;
}

uint64_t fe__form_of_tree(const fe__tree_link *links, int32_t count, fe__tree_kind kind, uint32_t locks)
{
    uint64_t form = mixed((uint64_t)count, (uint64_t)locks << 2 | (uint64_t)kind);
    for (const fe__tree_link *l = links; l < links + count; ++l)
        form = mixed(form, (uint64_t)(l->parent + 1) << 8 | (uint64_t)l->form);
    return form;
}

int32_t fe__trees_are_alike(const fe__forest *forest, int32_t a, const fe__forest *other, int32_t b)
{
    const fe__joint_tree *s = forest->trees + a, *t = other->trees + b;
    if (s->form != t->form || s->count != t->count || s->kind != t->kind || s->locks != t->locks) return 0;
    for (int32_t i = 0; i < s->count; ++i) {
        const fe__tree_link *l = forest->links + s->first + i, *m = other->links + t->first + i;
        if (l->parent != m->parent || l->form != m->form) return 0;
    }
    return 1;
}
