// rollback_udp.c - rollback between processes: two players and one who watches, over UDP on this machine.
//
//     cc rollback_udp.c -lfeather -lm -o rollback_udp && ./rollback_udp [--seconds N] [--seed N] [--rate N]
//     ./rollback_udp --desync FRAME      one player's world goes astray there: the first difference is named
//     ./rollback_udp --synctest N        no network: each frame goes back by N, and must come out the same
//
// The first process is the network, and it starts the others. It loses packets, delivers them late, twice, and out of
// order. Player 0 is the host; player 1 and who watches know the host alone.
//
//   keys      each packet holds all keys that the other has not confirmed, so that a lost one does no harm
//   joining   who comes later gets the host's world as a snapshot, in pieces of 1 KB, and asks for those that are lost.
//             Who watches comes after a third of the time. After 60 % player 1 is killed, and a new one takes over
//   desync    packets carry the hash of a frame whose keys are all known. Where two differ both save their worlds as
//             they were before that frame, and fe_snapshot_compare names the body and the field
//
// Predicted frames are never compared: they may differ, and will be mended. --rate is how many frames a second are
// played, 60 unless told; the network is as much faster. One byte order is assumed: a real game would choose one.
#define _GNU_SOURCE // MAP_ANONYMOUS
#include "rollback_session.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { HOST, GUEST, WATCHER, PEERS };
enum {
    SENT = 64,       // keys of a player in a packet
    CATCH_UP = 4,    // frames made in the time of one by who is behind
    LEAST_DELAY = 2, // frames that a packet takes, 33 to 133 ms
    MOST_DELAY = 8,
    LOST = 10,         // percent
    DOUBLED = 5,       // percent
    UNDER_WAY = 1024,  // packets
    PIECE = 1024,      // bytes of a snapshot in a packet
    MOST_PIECES = 256, // of a snapshot
    BURST = 16         // pieces sent at once
};

static struct options {
    int seconds, rate, synctest, desync;
    uint32_t seed;
} options = {10, 60, 0, NO_FRAME, 1};

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

// ---- packets --------------------------------------------------------------------------------------------------------
typedef enum kind { KEYS, JOIN, PIECES } kind;

typedef struct keys {
    int32_t first, count;
    uint8_t keys[SENT];
} keys;

typedef struct packet {
    uint32_t kind, from, to;
    uint32_t life;          // of the guest: what an earlier one sent does not count
    int32_t known[PLAYERS]; // the first frames whose keys the sender does not know
    int32_t checked;        // a frame whose keys it all knows
    int32_t differs;        // the first frame that it found to differ, or NO_FRAME
    uint64_t hash;          // of its world before `checked`
    union {
        keys players[PLAYERS];        // KEYS
        uint8_t has[MOST_PIECES / 8]; // JOIN: a bit for each piece
        struct {
            int32_t frame, index, count; // PIECES: of the world before `frame`
            uint8_t bytes[PIECE];
        } piece;
    } of;
} packet;

// What all processes see
typedef struct report {
    int32_t confirmed, joined; // frames; from which frame on
    int32_t rollbacks, repeated;
    int32_t differs; // frame, or NO_FRAME
    int64_t snapshot_size;
    uint64_t hash[MOST_FRAMES + 1];        // of confirmed frames; 0: it was not there
    uint8_t snapshot[MOST_PIECES * PIECE]; // of a world that differs
} report;

static struct shared {
    volatile int32_t over;
    report reports[PEERS];
} * shared;
static int sockets[PEERS + 1]; // the last is the network's
static struct sockaddr_in addresses[PEERS + 1];

static void open_sockets(void)
{
    for (int i = 0; i <= PEERS; ++i) {
        socklen_t size = sizeof addresses[i];
        addresses[i] = (struct sockaddr_in){.sin_family = AF_INET, .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
        sockets[i] = socket(AF_INET, SOCK_DGRAM, 0);
        if (sockets[i] < 0 || bind(sockets[i], (struct sockaddr *)&addresses[i], size) != 0 ||
            getsockname(sockets[i], (struct sockaddr *)&addresses[i], &size) != 0) {
            perror("UDP on 127.0.0.1");
            exit(1);
        }
    }
}

static void send_to(int from, int to, const packet *p)
{
    // a full socket loses it: as any network may
    (void)!sendto(sockets[from], p, sizeof *p, 0, (struct sockaddr *)&addresses[to], sizeof addresses[to]);
}

// Waits until there is one, but not longer than `until`. 0: there is none
static int next_packet(int socket, double until, packet *p)
{
    double left = until - now();
    struct pollfd wait = {.fd = sockets[socket], .events = POLLIN};
    if (poll(&wait, 1, left > 0.0 ? (int)(1e3 * left) : 0) <= 0) return 0;
    return recv(sockets[socket], p, sizeof *p, MSG_DONTWAIT) == (ssize_t)sizeof *p;
}

// ---- the network ----------------------------------------------------------------------------------------------------
typedef struct network {
    packet packets[UNDER_WAY];
    double arrives[UNDER_WAY]; // 0: free
    uint32_t chance;
    int sent, lost, doubled;
} network;

static void put(network *n, const packet *p, double frame_time)
{
    double late = (double)(LEAST_DELAY * 100 + (int)draw(&n->chance, 100 * (MOST_DELAY - LEAST_DELAY))) / 100.0;
    for (int i = 0; i < UNDER_WAY; ++i) {
        if (n->arrives[i] > 0.0) continue;
        n->packets[i] = *p;
        n->arrives[i] = now() + late * frame_time;
        return;
    }
}

static void take_in(network *n, const packet *p, double frame_time)
{
    if (p->to >= PEERS) return;
    ++n->sent;
    if (draw(&n->chance, 100) < LOST) {
        ++n->lost;
        return;
    }
    put(n, p, frame_time);
    if (draw(&n->chance, 100) >= DOUBLED) return;
    ++n->doubled;
    put(n, p, frame_time);
}

static void pass_on(network *n)
{
    double time = now();
    for (int i = 0; i < UNDER_WAY; ++i) {
        if (n->arrives[i] <= 0.0 || n->arrives[i] > time) continue;
        send_to(PEERS, (int)n->packets[i].to, &n->packets[i]);
        n->arrives[i] = 0.0;
    }
}

// ---- a world on its way to who joins --------------------------------------------------------------------------------
typedef struct parcel {
    state now;      // what the game keeps beside the world
    int32_t frame;  // of the world
    int32_t resume; // the first key of player 1 that nobody has
    int64_t size;   // of the snapshot, which follows
} parcel;

// Pieces as they are sent, or as far as they have come
typedef struct transfer {
    uint32_t life; // of whom it is for
    int32_t frame, count;
    uint8_t has[MOST_PIECES / 8];
    uint8_t bytes[MOST_PIECES * PIECE];
} transfer;

static int has_piece(const uint8_t *has, int i) { return has[i / 8] >> i % 8 & 1; }

// A world whose keys are all known. The frames since are made again
static void pack_world(session *s, transfer *out)
{
    int now = s->frame, frame = confirmed(s);
    if (frame < now) return_to(s, frame);
    parcel head = {s->game.now, frame, s->known[GUEST], 0};
    head.size =
        fe_world_save(s->game.world, NULL, out->bytes + sizeof head, (int64_t)(sizeof out->bytes - sizeof head));
    must(head.size > (int64_t)(sizeof out->bytes - sizeof head) ? FE_ERROR_LIMIT : (int32_t)head.size);
    memcpy(out->bytes, &head, sizeof head);
    out->frame = frame, out->count = (int32_t)((head.size + (int64_t)sizeof head + PIECE - 1) / PIECE);
    if (frame == now) return;
    make_frame(s);
    while (s->frame < now) keep_and_make_frame(s);
}

// ---- a process that plays -------------------------------------------------------------------------------------------
typedef struct peer {
    session session;
    int self, frames;
    uint32_t life;         // of this guest
    int resume;            // its keys below are what an earlier one sent: the host tells them
    uint32_t lives[PEERS]; // of the others, as they joined
    int joined[PEERS];     // does it play with that one?
    int32_t acknowledged[PEERS][PLAYERS];
    transfer parcels[PEERS]; // for who joins; one's own on the way in
} peer;

// Of frames that differ the earliest that both can go back to. Nothing is played after that
static void note_difference(peer *me, int frame)
{
    report *r = &shared->reports[me->self];
    session *s = &me->session;
    if ((r->differs != NO_FRAME && frame >= r->differs) || frame <= s->frame - HISTORY) return;
    if (frame < s->frame) return_to(s, frame);
    r->snapshot_size = fe_world_save(s->game.world, NULL, r->snapshot, sizeof r->snapshot);
    must((int32_t)r->snapshot_size);
    r->differs = frame;
}

static void read_keys(peer *me, const packet *p)
{
    session *s = &me->session;
    int from = (int)p->from;
    if (p->life != me->lives[from]) return;
    for (int who = 0; who < PLAYERS; ++who) {
        const keys *k = &p->of.players[who];
        for (int i = 0; i < k->count && i < SENT; ++i) learn(s, who, k->first + i, k->keys[i]);
        if (p->known[who] > me->acknowledged[from][who]) me->acknowledged[from][who] = p->known[who];
    }
    me->joined[from] = 1;
    if (s->wrong < s->frame) go_back(s, s->wrong);
    if (p->differs != NO_FRAME && p->differs <= confirmed(s)) note_difference(me, p->differs);
    if (p->checked <= confirmed(s) && p->checked >= shared->reports[me->self].joined && p->hash != s->hash[p->checked])
        note_difference(me, p->checked);
}

// Somebody begins anew: a world is packed for it, and sent piece by piece
static void read_join(peer *me, const packet *p)
{
    int from = (int)p->from;
    transfer *t = &me->parcels[from];
    if (me->self != HOST || p->life < me->lives[from]) return;
    if (t->count == 0 || t->life != p->life) {
        t->life = me->lives[from] = p->life;
        pack_world(&me->session, t);
        for (int who = 0; who < PLAYERS; ++who) me->acknowledged[from][who] = t->frame;
    }
    packet piece = {.kind = PIECES, .from = HOST, .to = p->from, .life = p->life, .differs = NO_FRAME};
    piece.of.piece.frame = t->frame, piece.of.piece.count = t->count;
    for (int i = 0, burst = 0; i < t->count && burst < BURST; ++i) {
        if (has_piece(p->of.has, i)) continue;
        piece.of.piece.index = i;
        memcpy(piece.of.piece.bytes, t->bytes + PIECE * i, PIECE);
        send_to(HOST, PEERS, &piece);
        ++burst;
    }
}

static void open_parcel(peer *me)
{
    const transfer *t = &me->parcels[me->self];
    parcel head;
    memcpy(&head, t->bytes, sizeof head);
    game_begin(&me->session.game);
    must(fe_world_restore(me->session.game.world, NULL, t->bytes + sizeof head, head.size));
    me->session.game.now = head.now;
    session_begin(&me->session, head.frame);
    me->resume = me->self == GUEST ? head.resume : 0;
    shared->reports[me->self].joined = shared->reports[me->self].confirmed = head.frame;
}

static void join_game(peer *me)
{
    transfer *t = &me->parcels[me->self];
    for (int missing = MOST_PIECES; missing;) {
        packet p = {.kind = JOIN, .from = (uint32_t)me->self, .to = HOST, .life = me->life, .differs = NO_FRAME};
        memcpy(p.of.has, t->has, sizeof t->has);
        send_to(me->self, PEERS, &p);
        double until = now() + 4.0 * MOST_DELAY / options.rate;
        while (missing && next_packet(me->self, until, &p)) {
            int i = p.of.piece.index;
            if (p.kind != PIECES || p.life != me->life || i < 0 || i >= MOST_PIECES || has_piece(t->has, i)) continue;
            t->has[i / 8] = (uint8_t)(t->has[i / 8] | 1 << i % 8);
            memcpy(t->bytes + PIECE * i, p.of.piece.bytes, PIECE);
            t->count = p.of.piece.count;
            missing = 0;
            for (int k = 0; k < t->count; ++k) missing += !has_piece(t->has, k);
        }
        if (shared->over) exit(0);
    }
    open_parcel(me);
}

// One's own keys, but for those that an earlier self has sent
static void press_keys(peer *me)
{
    session *s = &me->session;
    int self = me->self;
    while (s->known[self] >= me->resume && s->known[self] <= s->frame + INPUT_DELAY)
        learn(s, self, s->known[self], keys_of(self, s->known[self]));
}

// How many frames to make now
static int frames_to_make(const peer *me)
{
    const session *s = &me->session;
    int known = s->known[0] < s->known[1] ? s->known[0] : s->known[1], behind = known - s->frame;
    if (shared->reports[me->self].differs != NO_FRAME || s->known[me->self % PLAYERS] < me->resume) return 0;
    if (behind > AHEAD || me->self == WATCHER) return behind < CATCH_UP ? behind : CATCH_UP;
    return s->frame - s->known[1 - me->self] < AHEAD;
}

static void play_frames(peer *me)
{
    session *s = &me->session;
    for (int left = frames_to_make(me); left > 0 && s->frame < me->frames; --left) {
        if (me->self != WATCHER) press_keys(me);
        keep_and_make_frame(s);
    }
}

static void send_keys(const peer *me, int to)
{
    const session *s = &me->session;
    int frame = confirmed(s);
    packet p = {.kind = KEYS, .from = (uint32_t)me->self, .to = (uint32_t)to, .life = me->lives[to]};
    p.checked = frame, p.hash = s->hash[frame], p.differs = shared->reports[me->self].differs;
    for (int who = 0; who < PLAYERS; ++who) {
        keys *k = &p.of.players[who];
        p.known[who] = s->known[who];
        k->first = me->acknowledged[to][who];
        k->count = s->known[who] - k->first;
        if (k->count <= 0) k->count = 0;
        if (k->count > SENT) k->count = SENT;
        memcpy(k->keys, s->keys[who] + k->first, (size_t)k->count);
    }
    send_to(me->self, PEERS, &p);
}

static void tell(const peer *me)
{
    report *r = &shared->reports[me->self];
    int end = r->differs == NO_FRAME ? confirmed(&me->session) : r->confirmed;
    for (int frame = r->confirmed; frame <= end; ++frame) r->hash[frame] = me->session.hash[frame];
    r->confirmed = end, r->rollbacks = me->session.rollbacks, r->repeated = me->session.repeated;
}

// It lasts until the first process says so, or is gone
static void play(int self, uint32_t life, int frames)
{
    static peer me;
    pid_t parent = getppid();
    me.self = self, me.life = me.lives[HOST] = life, me.frames = frames;
    if (self == WATCHER || life > 0) {
        join_game(&me);
    } else {
        game_begin(&me.session.game);
        session_begin(&me.session, 0);
    }
    if (self == GUEST) me.session.fault = options.desync;
    me.joined[self == HOST ? GUEST : HOST] = 1;
    double frame_time = 1.0 / options.rate;
    for (double next = now(); !shared->over && getppid() == parent;) {
        packet p;
        while (next_packet(self, next, &p)) {
            if (p.from >= PEERS) continue;
            if (p.kind == KEYS) read_keys(&me, &p);
            if (p.kind == JOIN) read_join(&me, &p);
        }
        play_frames(&me);
        tell(&me);
        for (int to = 0; to < PEERS; ++to)
            if (me.joined[to]) send_keys(&me, to);
        next = next + frame_time > now() ? next + frame_time : now();
    }
    must(fe_world_destroy(me.session.game.world));
}

// ---- the first process ----------------------------------------------------------------------------------------------
static pid_t begin_process(int self, uint32_t life, int frames)
{
    fflush(stdout);
    pid_t process = fork();
    if (process < 0) perror("fork"), exit(1);
    if (process > 0) return process;
    play(self, life, frames);
    exit(0);
}

static void end_process(pid_t process)
{
    if (process <= 0) return;
    kill(process, SIGKILL);
    waitpid(process, NULL, 0);
}

// Do those that play agree that they do not?
static int is_astray(void)
{
    const report *r = shared->reports;
    return r[HOST].differs != NO_FRAME && r[HOST].differs == r[GUEST].differs;
}

static int is_done(int frames)
{
    for (int i = 0; i < PEERS; ++i)
        if (shared->reports[i].confirmed < frames) return 0;
    return 1;
}

// Passes on packets until the game is over. 0: it was not in time
static int run_game(network *n, int frames)
{
    const double patience = 20.0, frame_time = 1.0 / options.rate; // s
    double deadline = now() + 4.0 * frames * frame_time + patience;
    pid_t processes[PEERS] = {begin_process(HOST, 0, frames), begin_process(GUEST, 0, frames), 0};
    int is_killed = options.desync != NO_FRAME;
    while (!is_done(frames) && !is_astray() && now() < deadline) {
        packet p;
        if (next_packet(PEERS, now() + 0.001, &p)) take_in(n, &p, frame_time);
        pass_on(n);
        int32_t confirmed = shared->reports[HOST].confirmed;
        if (processes[WATCHER] == 0 && confirmed >= frames / 3) processes[WATCHER] = begin_process(WATCHER, 1, frames);
        if (is_killed || confirmed < frames * 3 / 5) continue;
        is_killed = 1;
        end_process(processes[GUEST]);
        processes[GUEST] = begin_process(GUEST, 1, frames);
    }
    int in_time = now() < deadline;
    shared->over = 1;
    for (int i = 0; i < PEERS; ++i) {
        if (in_time && processes[i] > 0) waitpid(processes[i], NULL, 0), processes[i] = 0;
        end_process(processes[i]);
    }
    return in_time;
}

// The game without a network, with every key known
static void play_alone(uint64_t *hash, int frames)
{
    game g;
    game_begin(&g);
    for (int frame = 0; frame <= frames; ++frame) {
        uint8_t held[PLAYERS];
        for (int p = 0; p < PLAYERS; ++p) held[p] = keys_of(p, frame);
        hash[frame] = game_hash(&g);
        game_step(&g, held);
    }
    must(fe_world_destroy(g.world));
}

static int tell_difference(void)
{
    const report *a = &shared->reports[HOST], *b = &shared->reports[GUEST];
    fe_difference d;
    fe_difference_init(&d, sizeof d);
    int32_t differ = must(fe_snapshot_compare(a->snapshot, a->snapshot_size, b->snapshot, b->snapshot_size, &d));
    printf("before frame %d: %s %llx: %s[%d] is %s for the host and %s for the guest\n", a->differs, d.kind,
           (unsigned long long)d.handle, d.field, d.element, d.a, d.b);
    return differ == 1;
}

static int tell_agreement(int frames)
{
    static const char *const names[PEERS] = {"host", "guest", "watcher"};
    static uint64_t alone[MOST_FRAMES + 1];
    int differ = 0, checked = 0;
    play_alone(alone, frames);
    for (int i = 0; i < PEERS; ++i) {
        const report *r = &shared->reports[i];
        printf("%s: joined before frame %d, went back %d times, made %d frames again\n", names[i], r->joined,
               r->rollbacks, r->repeated);
        for (int frame = 0; frame <= frames; ++frame) {
            checked += r->hash[frame] != 0;
            differ += r->hash[frame] != 0 && r->hash[frame] != alone[frame];
        }
    }
    printf("of %d confirmed frames %d differ from the game without a network\n", checked, differ);
    return differ == 0 && checked > PEERS * frames / 2;
}

static int play_together(int frames)
{
    static network n;
    n.chance = options.seed;
    shared = mmap(NULL, sizeof *shared, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (shared == MAP_FAILED) return 0;
    for (int i = 0; i < PEERS; ++i) shared->reports[i].differs = NO_FRAME;
    open_sockets();
    int in_time = run_game(&n, frames);
    printf("%d frames; of %d packets %d were lost, %d came twice\n", frames, n.sent, n.lost, n.doubled);
    if (!in_time) printf("the time was not enough\n");
    if (!in_time) return 0;
    return is_astray() ? tell_difference() && options.desync != NO_FRAME : tell_agreement(frames);
}

// What the world is must not depend on whether it went back
static int test_going_back(int frames, int back)
{
    static session s;
    static uint64_t alone[MOST_FRAMES + 1];
    int differ = 0;
    play_alone(alone, frames);
    game_begin(&s.game);
    session_begin(&s, 0);
    while (s.frame < frames) {
        for (int p = 0; p < PLAYERS; ++p) learn(&s, p, s.frame, keys_of(p, s.frame));
        keep_and_make_frame(&s);
        go_back(&s, s.frame > back ? s.frame - back : 0);
        differ += s.hash[s.frame] != alone[s.frame];
    }
    printf("%d frames, each went back by %d: %d differ\n", frames, back, differ);
    must(fe_world_destroy(s.game.world));
    return differ == 0;
}

static void read_options(int argc, char **argv)
{
    for (int i = 1; i < argc; i += 2) {
        int value = i + 1 < argc ? atoi(argv[i + 1]) : 0;
        if (strcmp(argv[i], "--seconds") == 0 && value > 0 && value <= 60)
            options.seconds = value;
        else if (strcmp(argv[i], "--rate") == 0 && value > 0 && value <= 1000)
            options.rate = value;
        else if (strcmp(argv[i], "--seed") == 0)
            options.seed = (uint32_t)value;
        else if (strcmp(argv[i], "--desync") == 0 && value > 0)
            options.desync = value;
        else if (strcmp(argv[i], "--synctest") == 0 && value > 0 && value < HISTORY)
            options.synctest = value;
        else
            printf("no option %s, or not with that number: see the head of rollback_udp.c\n", argv[i]), exit(1);
    }
}

int main(int argc, char **argv)
{
    read_options(argc, argv);
    int frames = 60 * options.seconds;
    return !(options.synctest ? test_going_back(frames, options.synctest) : play_together(frames));
}
