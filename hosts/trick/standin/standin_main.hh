/* The executive: included behind the simulation, whose everything() visits each number by its name. */
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <set>
#include <sstream>
#include <thread>

const std::vector<unsigned char> &allocation(void *address);

namespace standin {

/* Writes every number as Trick does with TMM_hexfloat_checkpoint(1): no bit is lost. */
struct Writer {
    FILE *file;
    bool hexfloat;

    void number(const std::string &name, double x) {
        fprintf(file, hexfloat ? "%s = %a\n" : "%s = %.14g\n", name.c_str(), x);
    }
    void number(const std::string &name, int x) { fprintf(file, "%s = %d\n", name.c_str(), x); }
    void number(const std::string &name, unsigned int x) { fprintf(file, "%s = %u\n", name.c_str(), x); }
    void number(const std::string &name, Regula_Falsi x) { number(name, int(x)); }
    void number(const std::string &name, const std::string &x) { fprintf(file, "%s = %s\n", name.c_str(), x.c_str()); }
    void allocated(const std::string &name, unsigned char *x) {
        fprintf(file, "%s =", name.c_str());
        for (unsigned char byte : x == nullptr ? std::vector<unsigned char>() : allocation(x)) {
            fprintf(file, " %u", byte);
        }
        fputc('\n', file);
    }
};

/* Gives numbers the values of a table; a name that nothing has is told by `used`. */
struct Reader {
    const std::map<std::string, std::string> &values;
    std::set<std::string> used;

    const char *find(const std::string &name) {
        const auto found = values.find(name);
        if (found == values.end()) {
            return nullptr;
        }
        used.insert(name);
        return found->second.c_str();
    }
    void number(const std::string &name, double &x) {
        const char *v = find(name);
        x = v ? strtod(v, nullptr) : x;
    }
    void number(const std::string &name, int &x) {
        const char *v = find(name);
        x = v ? int(strtol(v, nullptr, 10)) : x;
    }
    void number(const std::string &name, unsigned int &x) {
        const char *v = find(name);
        x = v ? unsigned(strtoul(v, nullptr, 10)) : x;
    }
    void number(const std::string &name, Regula_Falsi &x) {
        int i = x;
        number(name, i);
        x = Regula_Falsi(i);
    }
    void number(const std::string &name, std::string &x) {
        const char *v = find(name);
        x = v ? v : x;
    }
    void allocated(const std::string &name, unsigned char *&x) {
        const char *v = find(name);
        std::vector<unsigned char> bytes;
        std::istringstream in(v ? v : "");
        for (unsigned byte; in >> byte;) {
            bytes.push_back((unsigned char)byte);
        }
        if (v != nullptr) {
            void *made = bytes.empty() ? nullptr : TMM_declare_var_1d("unsigned char", int(bytes.size()));
            x = static_cast<unsigned char *>(made);
            std::copy(bytes.begin(), bytes.end(), x);
        }
    }
};

/* Collects the recorded numbers. */
struct Sampler {
    std::map<std::string, double> values;

    void number(const std::string &name, double x) { values[name] = x; }
    template <class T>
    void number(const std::string &, const T &) {}
    void allocated(const std::string &, unsigned char *) {}
};

/* One tic is a microsecond, as in Trick. */
const double TIC = 1e-6;

struct Executive {
    std::string folder;
    long long tics = 0, stop = 0, software_frame = 0;
    bool hexfloat = false, real_time = false, restarted = false;
    std::string checkpoint_to_load;
    std::set<long long> checkpoints, freezes;
    std::vector<std::string> recorded;
    long long record_cycle = 0, overruns = 0;

    static long long to_tics(const std::string &seconds) { return llround(strtod(seconds.c_str(), nullptr) / TIC); }
    void command(const std::string &line);
    void write_checkpoint();
    void load_checkpoint();
    void record(FILE *file);
    int run();
};

inline void refuse(const std::string &text) {
    fprintf(stderr, "%s\n", text.c_str());
    exit(1);
}

inline void Executive::command(const std::string &line) {
    std::istringstream in(line);
    std::string name, a, b;
    in >> name >> a >> b;
    if (name == "set") {
        const std::map<std::string, std::string> one{{a, b}};
        Reader reader{one, {}};
        everything(reader);
        if (reader.used.empty()) {
            refuse(a + ": the simulation has nothing of this name");
        }
    } else if (name == "trick.stop") {
        stop = to_tics(a);
    } else if (name == "trick.checkpoint") {
        checkpoints.insert(to_tics(a));
    } else if (name == "trick.freeze") {
        freezes.insert(to_tics(a));
    } else if (name == "trick.TMM_hexfloat_checkpoint") {
        hexfloat = a == "1";
    } else if (name == "trick.load_checkpoint") {
        checkpoint_to_load = a;
    } else if (name == "trick.load_checkpoint_job") {
        load_checkpoint();
    } else if (name == "trick.real_time_enable") {
        real_time = true;
    } else if (name == "trick.exec_set_software_frame") {
        software_frame = to_tics(a);
    } else if (name.size() > 13 && name.substr(name.size() - 13) == ".add_variable") {
        recorded.push_back(a);
    } else if (name.size() > 10 && name.substr(name.size() - 10) == ".set_cycle") {
        record_cycle = to_tics(a);
    } else if (name != "trick.DRAscii" && name != "trick.add_data_record_group" && name != "trick.itimer_enable" &&
               name != "trick.exec_set_enable_freeze") {
        refuse(line + ": this command is not known");
    }
}

inline void Executive::write_checkpoint() {
    char name[64];
    snprintf(name, sizeof name, "/chkpnt_%f", double(tics) * TIC);
    call_jobs(*Trick::the_object(), "checkpoint");
    FILE *file = fopen((folder + name).c_str(), "w");
    if (file == nullptr) {
        refuse(folder + name + ": cannot be written");
    }
    fprintf(file, "tics = %lld\n", tics);
    Writer writer{file, hexfloat};
    everything(writer);
    fclose(file);
    call_jobs(*Trick::the_object(), "post_checkpoint");
}

inline void Executive::load_checkpoint() {
    std::ifstream file(checkpoint_to_load);
    std::map<std::string, std::string> values;
    for (std::string line; std::getline(file, line);) {
        const size_t at = line.find(" =");
        values[line.substr(0, at)] = line.size() > at + 3 ? line.substr(at + 3) : "";
    }
    if (values.empty()) {
        refuse(checkpoint_to_load + ": there is no such checkpoint");
    }
    call_jobs(*Trick::the_object(), "preload_checkpoint");
    tics = strtoll(values.at("tics").c_str(), nullptr, 10);
    Reader reader{values, {}};
    everything(reader);
    if (reader.used.size() + 1 != values.size()) {
        refuse(checkpoint_to_load + ": is a checkpoint of another simulation");
    }
    call_jobs(*Trick::the_object(), "restart");
    restarted = true;
}

inline void Executive::record(FILE *file) {
    Sampler sampler;
    everything(sampler);
    fprintf(file, "%.17g", double(tics) * TIC);
    for (const std::string &name : recorded) {
        fprintf(file, ",%.17g", sampler.values.at(name));
    }
    fputc('\n', file);
}

inline int Executive::run() {
    using clock = std::chrono::steady_clock;
    Trick::SimObject &object = *Trick::the_object();
    create_connections();
    call_jobs(object, "default_data");
    for (std::string line; std::getline(std::cin, line);) {
        command(line);
    }
    if (!restarted) {
        call_jobs(object, "initialization");
    }
    FILE *file = recorded.empty() ? nullptr : fopen((folder + "/log_motion.csv").c_str(), "w");
    if (file != nullptr) {
        record(file);
    }
    const long long cycle = llround(Trick::the_loop()->cycle / TIC);
    clock::time_point release = clock::now();
    while (tics < stop) {
        if (real_time && software_frame > 0 && tics % software_frame == 0) {
            call_jobs(object, "end_of_frame");
            overruns += clock::now() > release;
            std::this_thread::sleep_until(release);
            release += std::chrono::microseconds(software_frame);
            call_jobs(object, "top_of_frame");
        }
        tics += cycle;
        Trick::the_loop()->integrate(double(tics) * TIC);
        if (file != nullptr && tics % record_cycle == 0) {
            record(file);
        }
        if (checkpoints.count(tics) != 0) {
            write_checkpoint();
        }
        if (freezes.count(tics) != 0) {
            const clock::time_point frozen = clock::now();
            call_jobs(object, "freeze_init");
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
            call_jobs(object, "unfreeze");
            release += clock::now() - frozen;
        }
    }
    if (file != nullptr) {
        fclose(file);
    }
    Sampler sampler;
    everything(sampler);
    printf("stopped at %.6f s, %lld frames of the clock overrun\n", double(tics) * TIC, overruns);
    for (const auto &value : sampler.values) {
        if (value.first.find("touch_time") != std::string::npos) {
            printf("%s = %.17g\n", value.first.c_str(), value.second);
        }
    }
    call_jobs(object, "shutdown");
    return 0;
}

} // namespace standin


int main(int count, char **arguments) {
    if (count != 2) {
        fprintf(stderr, "usage: %s FOLDER < commands\n", arguments[0]);
        return 2;
    }
    standin::Executive executive;
    executive.folder = arguments[1];
    return executive.run();
}
