// The C++ header in use: a ball dropped on the ground, stepped by a small explicit integrator.
//
//     c++ -std=c++17 cpp_smoke.cpp -I../include -L../target/debug -lpong -o cpp_smoke

#include <pong_cpp.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace {

const std::string head =
    "(format: \"pong-model\", version: 1, surfaces: {\"rubber\": (stiffness: 2e4, friction: Bristle(mu: 0.5))}, ";
const std::string ball_model = head + "name: \"ball\", root: (name: \"ball\", surface: \"rubber\", "
                                      "primitives: [Sphere(name: \"shell\", center: (0, 0, 0), radius: 0.1)]))";
const std::string ground_model = head + "name: \"ground\", root: (name: \"ground\", surface: \"rubber\", "
                                        "primitives: [Plane(name: \"floor\", normal: (0, 0, 1), offset: 0)]))";

// Memory that the program itself asks for: the C++ header must ask for none in a frame.
std::size_t allocations = 0;

void require(bool holds, const char* what) {
    if (!holds) {
        std::fprintf(stderr, "not so: %s\n", what);
        std::exit(1);
    }
}

pong::SealReport sealed{};

pong::World build() {
    pong_config config = pong_default_config();
    config.workers = 1;
    config.oversubscribe = 1;
    pong::World world(config);
    world.create_object(world.load_model_text(ball_model, "ball"), "ball");
    world.create_object(world.load_model_text(ground_model, "ground"), "ground");
    world.pair("ball", "ground");
    // What drop() does with it below.
    pong::Mass mass{};
    mass.mass = 1.0;
    world.set_mass(world.interface(world.object("ball")), mass);
    mass.mass = HUGE_VAL;
    world.set_mass(world.interface(world.object("ground")), mass);
    pong::StepPlan plan = pong_default_step_plan();
    plan.step = 1e-5;
    plan.wrench_coupling = PONG_COUPLING_SEMI_IMPLICIT;
    world.plan_step(plan);
    sealed = world.seal();
    require(sealed.warning_count == 0 && sealed.note_count == 0 && sealed.surely_stable_step > 1e-3, "a stable step");
    return world;
}

// A ball without losses comes back to where it was dropped.
void drop(pong::World& world) {
    const double mass = 1.0, gravity = 9.81, dt = 1e-5, height = 0.12;
    const pong::InterfaceId ball = world.interface(world.object("ball"));
    world.set_state(world.interface(world.object("ground")), pong::State());
    pong::State state;
    state.position[2] = height;
    double lowest = height, highest = 0.0;
    for (int frame = 0; frame < 20000; ++frame) {
        world.set_state(ball, state);
        world.step();
        const double up = world.wrench(ball, pong::Frame::common).force[2];
        state.linear_velocity[2] += dt * (up / mass - gravity);
        state.position[2] += dt * state.linear_velocity[2];
        lowest = std::fmin(lowest, state.position[2]);
        highest = frame > 10000 ? std::fmax(highest, state.position[2]) : highest;
    }
    std::printf("lowest %.6f m, back to %.6f m\n", lowest, highest);
    require(lowest < 0.1 && std::fabs(highest - height) < 1e-4, "the ball bounces back");
}

// Groups that are kept apart never touch, in clones as well.
void keep_apart() {
    pong::World world;
    const pong::ObjectId ball = world.create_object(world.load_model_text(ball_model, "ball"), "ball");
    const pong::ObjectId ground = world.create_object(world.load_model_text(ground_model, "ground"), "ground");
    world.pair(ball, ground);
    world.filter_groups(ball, "", ground, "ground");
    pong::Mass mass{};
    mass.mass = 1.0;
    world.set_mass(world.interface(ball), mass);
    world.set_joints(world.interface(ball), pong::Joints{});
    require(world.seal().group_pairs == 0, "nothing is left to test");
    pong::World clone = world.clone();
    for (pong::World* each : {&world, &clone}) {
        pong::State state;
        each->set_state(each->interface(ground), state);
        each->set_state(each->interface(ball), state);
        each->step();
        require(each->contacts().empty(), "no contact of what is kept apart");
    }
}

void refuse(pong::World& world) {
    try {
        world.object("moon");
        require(false, "an unknown name throws");
    } catch (const pong::Error& error) {
        require(error.status() == PONG_STATUS_UNKNOWN_NAME, "the status comes along");
        require(std::string(error.what()).find("`moon`") != std::string::npos, "the message comes along");
    }
}

void list_and_restore(pong::World& world) {
    const pong::InterfaceId ball = world.interfaces(world.object("ball")).front();
    pong::State state;
    state.position = {1e-4, 0.0, 0.098};
    world.clear_contact_history(world.object("ball"));
    world.set_state(ball, pong::State(pong_state(state)));
    world.step();
    const auto saved = world.save_contact_state();
    const std::vector<pong::Contact> contacts = world.contacts();
    const auto stiffness = world.contact_stiffness();
    require(stiffness.size() == 1 && std::fabs(stiffness[0].first * contacts[0].depth / contacts[0].normal_force - 1) < 1e-9,
            "stiffness times depth is the force of a contact that does not move");
    require(contacts.size() == 1 && std::fabs(contacts[0].depth - 0.002) < 1e-12, "one contact, 2 mm deep");
    const pong::InterfaceId ground = world.interfaces(world.object("ground")).front();
    const double up = world.wrench(ball, pong::Frame::common).force[2];
    require(world.wrench_from(ball, ground, pong::Frame::common).force[2] == up &&
                world.pair_wrench(contacts[0].pair, ground, pong::Frame::common).force[2] == up,
            "the ground alone pushes the ball");
    const pong::Distance distance = world.distance(ball, ground);
    require(distance.distance == 0.0 && distance.primitives[0] == contacts[0].a.primitive, "the ball is in the ground");
    require(std::string(world.primitive_path(contacts[0].a.interface, contacts[0].a.primitive)) == "ball/shell",
            "the contact names the sphere");
    world.start_pair_monitor();
    world.evaluate();
    const auto tangents = world.tangents(), differences = world.tangents_by_differences();
    const double up_by_up = tangents[0].stiffness[0][0][14];
    require(world.complete_tangents()[0].stiffness[0][0][14] == up_by_up, "complete tangents are those in closed form");
    require(tangents.size() == 1 && differences.size() == 1 && std::fabs(up_by_up / stiffness[0].first - 1) < 1e-9 &&
                std::fabs(differences[0].stiffness[0][0][14] / up_by_up - 1) < 1e-4 &&
                world.contact_tangents()[0].normal_stiffness == stiffness[0].first,
            "a ball on the ground has the stiffness of its contact");
    world.step();
    world.observe_pairs(1e-3);
    const auto changes = world.contact_changes();
    require(changes.size() == 1 && changes[0].begins == 1 && changes[0].interfaces[0].bits == ball.bits, "contact begins");
    const auto peaks = world.pair_peaks();
    require(peaks.size() == 1 && peaks[0].peak_normal_force > 0 && peaks[0].mean.force[2] > 0, "the window has a peak");
    world.begin_peak_window();
    require(world.pair_peaks().empty(), "a new window has none");
    world.restore_contact_state(saved);
    require(world.save_contact_state() == saved, "the contact state survives a round trip");
    const pong::World clone = world.clone();
    require(clone.save_contact_state() == saved && clone.get() != world.get(), "a clone remembers the same");
    pong::World longer = world.extended();
    longer.create_object(longer.load_model_text(ground_model, "ground"), "second_ground");
    longer.pair("ball", "second_ground");
    longer.seal();
    require(longer.continue_from(world).contacts == world.report().contacts, "contacts go on beside what arrived");
}

// Contacts and contact state go into memory that the caller has: a frame allocates nothing.
void use_memory_again(pong::World& world) {
    const pong::InterfaceId ball = world.interface(world.object("ball"));
    std::vector<pong::Contact> contacts;
    std::vector<unsigned char> bytes;
    contacts.reserve(sealed.contact_capacity);
    bytes.reserve(sealed.contact_state_size);
    pong::Contact own[4];
    const std::size_t before = allocations;
    for (int frame = 0; frame < 100; ++frame) {
        pong::State state;
        state.position = {1e-5 * frame, 0.0, frame % 3 == 0 ? 0.2 : 0.098};
        world.set_state(ball, state);
        world.step();
        world.contacts(contacts);
        world.save_contact_state(bytes);
        world.restore_contact_state(bytes.data(), bytes.size());
        require(contacts.size() == (frame % 3 == 0 ? 0u : 1u) && world.contacts(own, 4) == contacts.size(),
                "the contacts of the frame");
    }
    require(allocations == before, "a frame allocates nothing");
    require(own[0].depth == contacts[0].depth || contacts.empty(), "the same contact both ways");
    require(world.save_contact_state() == bytes, "the same state both ways");
}

// Primitives have numbers, and the host's numbers stay with them.
void keep_numbers(pong::World& world) {
    const pong::ObjectId object = world.object("ball");
    const pong::InterfaceId ball = world.interface(object);
    require(world.primitive_count(ball) == 1 && world.find_primitive(ball, "ball/shell") == 0, "one primitive");
    require(world.user_data(object) == 0 && world.user_data(ball, 0) == 0, "nothing is kept yet");
    world.set_user_data(object, 7);
    world.set_user_data(ball, 0, 11);
    require(world.user_data(object) == 7 && world.user_data(ball, 0) == 11, "the numbers are kept");
    pong::State state;
    state.position[2] = 0.098;
    world.set_state(ball, state);
    world.step();
    const pong::StepCheck check = world.check_step();
    require(check.stable_step > 1e-3 && check.stable_step < 1.0, "what one contact leaves of the step");
}

void look(pong::World& world) {
    world.prewake(std::chrono::microseconds(100));
    world.step();
    world.quiesce();
    const pong::Report report = world.report();
    require(report.flags == 0 && report.primitives_tested > 0, "the report is of the last frame");
    unsigned tested = 0;
    for (const pong::Tally& tally : world.tallies()) {
        tested += tally.what == PONG_TALLY_PRIMITIVES && std::string(tally.kind_a) == "Sphere" ? tally.tested : 0;
    }
    require(tested == report.primitives_tested, "the tallies tell the kinds");
    require(world.worker_count() == 1 && world.worker(1).index == 1, "one worker was started");
    require(std::string(world.worker_text(1)).find("worker 1") == 0, "it tells how it started");
}

void record(pong::World& world) {
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("cpp_smoke_log_" + std::to_string(std::random_device{}()));
    world.start_log(folder.string());
    for (int frame = 0; frame < 5; ++frame) {
        world.step();
        world.log_frame(0.1 * frame);
    }
    require(world.log_report().frames == 5, "the log counts frames");
    const pong::LogReport closed = world.stop_log();
    require(closed.flushed == 5 && closed.lost == 0, "every frame is in the log");
    require(std::filesystem::exists(folder / "wrenches.npy"), "the log has its tables");
    std::filesystem::remove_all(folder);
}

// A ball of 1 kg that rests on the ground in frames of 0.1 s is held up by its weight.
void hold(const pong::World& world) {
    pong::SlowHost host(world);
    std::vector<pong::SlowInput> inputs(2);
    inputs[0].interface = world.interface(world.object("ball"));
    inputs[1].interface = world.interface(world.object("ground"));
    inputs[0].state = inputs[1].state = pong::State();
    inputs[0].state.position[2] = 0.1 - 9.81e-4;
    inputs[0].dynamics = PONG_DYNAMICS_FREE;
    inputs[0].mass = {1.0, {4e-3, 4e-3, 4e-3, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
    inputs[0].linear_acceleration[2] = -9.81;
    inputs[1].dynamics = PONG_DYNAMICS_PRESCRIBED;
    host.step(0.1, inputs);
    const std::vector<unsigned char> state = host.save();
    host.evaluate(0.1, inputs);
    host.commit();
    require(std::fabs(host.wrench(inputs[0].interface, pong::Frame::common).force[2] - 9.81) < 1e-6, "the wrench holds the ball");
    require(host.report().substeps > 8 && host.differences().size() == 2, "the frame has its report");
    host.restore(state);
    require(host.save() == state, "a restored slow host has the same state");
}

} // namespace

void* operator new(std::size_t size) {
    ++allocations;
    void* memory = std::malloc(size);
    if (memory == nullptr) {
        throw std::bad_alloc();
    }
    return memory;
}

// Not inlined: the compiler would otherwise see memory of `new` go to `free`, and warn.
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

int main() {
    try {
        pong::World built = build();
        pong::World world = std::move(built);
        drop(world);
        keep_apart();
        refuse(world);
        list_and_restore(world);
        use_memory_again(world);
        keep_numbers(world);
        look(world);
        hold(world);
        record(world);
    } catch (const pong::Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    std::printf("cpp_smoke: passed\n");
    return 0;
}
