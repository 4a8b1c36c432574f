// rimline batch: a subcommand over many models, each in a process of its own.

#include <CLI/App.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "silhouette/printable_text.h"
#include "tools/batch/batch_inputs.h"
#include "tools/batch/batch_manifest.h"
#include "tools/batch/batch_merge.h"
#include "tools/batch/batch_page.h"
#include "tools/batch/batch_process.h"
#include "tools/batch/batch_subcommand.h"
#include "tools/batch/batch_task.h"
#include "tools/command.h"
#include "tools/options/exact_text.h"
#include "tools/options/model_argument.h"
#include "tools/options/option_types.h"
#include "tools/output/output_file.h"
#include "tools/process/thread_limit.h"
#include "tools/progress.h"

namespace rimline::tools {

namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds k_poll{5};

class BatchCommand final : public Command {
public:
    std::string name() const override { return "batch"; }
    std::string summary() const override { return "Run a subcommand over many models"; }
    void take_rest(std::vector<std::string> arguments) override { rest_ = std::move(arguments); }
    bool takes_rest() const override { return true; }

    void add_options(CLI::App& app) override {
        app.add_option("MODELS", sources_,
                       "Model files, folders of models, shape:NAME[:FACES], or @LIST, a text file "
                       "with one of these a line")
            ->required();
        app.add_option("-o,--output", folder_,
                       "Folder of the manifest and of the page; {out} in the subcommand's options")
            ->type_name("FOLDER")
            ->capture_default_str()
            ->group("Output");
        app.add_option("--page", page_, "Also write an HTML page with all pictures")
            ->type_name("FILE.html")
            ->group("Output");
        CLI::Option* dry =
            app.add_flag("--dry-run", is_dry_,
                         "Print the command of each model that is left to do, and do nothing")
                ->group("Output");
        add_count(app, "--jobs", jobs_, 1, 1024, "Models at a time (default: one a processor)")
            ->default_str("")
            ->group("Machine");
        add_number(app, "--timeout", timeout_s_, 0.01, 1e6,
                   "Seconds that a model may take (default: any)")
            ->group("Machine");
        add_number(
            app, "--memory", memory_mb_, 1.0, 1e9,
            "Megabytes of address space that a model may take; pictures need 1500 (default: any)")
            ->group("Machine");
        CLI::Option* shard =
            app.add_option_function<std::string>(
                   "--shard", [this](const std::string& text) { shard_ = parse_shard(text); },
                   "Do only part I of N parts, for N machines: I/N. Each has a manifest of its own")
                ->type_name("I/N")
                ->group("Machine");
        app.add_flag("--merge", merges_,
                     "Run nothing: add to the manifest what the manifests of shards have")
            ->excludes(shard)
            ->excludes(dry)
            ->group("Machine");
        app.add_flag("--wait", waits_, "Wait for another batch that writes the manifest")
            ->group("Machine");
        app.add_flag("--retry", retries_, "Do again what failed in an earlier run")
            ->group("Machine");
        app.footer(
            "A folder stands for the .obj, .ply, .stl, .off, .gltf, .glb, .xyz, .pts and .csv "
            "files in it "
            "and its\n"
            "subfolders, through links too, without names that begin with a dot. The names in a "
            "list are relative "
            "to\n"
            "the working directory.\n\n"
            "After -- comes a subcommand with its options, without the model. In these stand\n"
            "  {stem}  the name of the model's file without its ending\n"
            "  {name}  with its ending\n"
            "  {path}  within its folder or list, without its ending\n"
            "  {ext}   its ending without the dot; nothing for shapes\n"
            "  {out}   the folder of --output\n\n"
            "Each model runs in a process of its own. The manifest, manifest.jsonl in the folder, "
            "gets a\n"
            "line of JSON when a model is done: input, digest, command, status, ms, outputs, "
            "error, and\n"
            "result, what the subcommand prints with --json. A batch that was ended goes on where "
            "it was:\n"
            "what has a line with the same digest and command, and its outputs, is not done "
            "again. The exit\n"
            "status is 1 if a model failed. --threads N limits the threads of all models "
            "together.\n\n"
            "Examples:\n"
            "  rimline batch models -- views -k 4 --size 512x512 -o {out}/{path}\n"
            "  rimline batch @list.txt --shard 2/8 --timeout 60 --page all.html -- render -o "
            "{out}/{stem}.png\n"
            "  rimline batch @list.txt --merge -- render -o {out}/{stem}.png\n"
            "  rimline batch models --json -- info");
    }

    ExitStatus run(const Context& context) override {
        check_page();
        check_batch_subcommand(rest_);
        const std::vector<BatchTask> tasks = make_tasks(context);
        context.times.end("finding models");
        if (is_dry_ && !fs::exists(manifest_path())) {
            std::vector<const BatchTask*> all;
            for (const BatchTask& task : tasks) all.push_back(&task);
            return print_dry(context, tasks, all, 0.0);
        }
        if (is_dry_) {
            const BatchManifest manifest = BatchManifest::as_it_is(manifest_path());
            const std::vector<const BatchTask*> left = tasks_left(tasks, manifest, context);
            return print_dry(context, tasks, left, mean_ms(manifest));
        }
        make_folder(folder_);
        const LongCall wait{context.stop, {}};
        BatchManifest manifest(manifest_path(), waits_ ? &wait : nullptr);
        if (merges_) return merge(tasks, manifest, context);
        const std::vector<const BatchTask*> left = tasks_left(tasks, manifest, context);
        std::optional<OutputFile> page;
        if (!page_.empty()) page.emplace(page_);
        run_all(left, manifest, context);
        context.times.end("running");
        if (page) write_page(tasks, manifest, *page);
        return print_result(context, tasks);
    }

private:
    fs::path manifest_path() const { return batch_manifest_path(folder_, shard_); }

    // What failed in an earlier run comes last.
    std::vector<const BatchTask*> tasks_left(const std::vector<BatchTask>& tasks,
                                             const BatchManifest& manifest,
                                             const Context& context) {
        std::vector<const BatchTask*> left, failed;
        Progress progress(context, "reading models");
        const LongCall call = progress.call();
        for (const BatchTask& task : tasks) {
            call.checkpoint(double(&task - tasks.data()) / double(tasks.size()));
            const BatchEntry* const entry = manifest.find(task.key);
            const bool is_failed = entry != nullptr && entry->status != "ok";
            if (!is_done(task, manifest, call)) {
                (is_failed ? failed : left).push_back(&task);
            } else if (is_failed) {
                ++failed_before_;
                add_failure(failures_before_, task, entry->error);
            } else {
                ++skipped_;
            }
        }
        left.insert(left.end(), failed.begin(), failed.end());
        context.times.end("reading models");
        return left;
    }

    // Of the models that this subcommand has done; 0 if there are none.
    double mean_ms(const BatchManifest& manifest) const {
        double ms = 0.0;
        std::size_t count = 0;
        for (const auto& [input, entry] : manifest.entries()) {
            if (entry.status != "ok" || !entry.command.starts_with(rest_.front() + " ")) continue;
            ms += entry.ms;
            ++count;
        }
        return count > 0 ? ms / double(count) : 0.0;
    }

    // The outputs are looked for, and models are read only where shards differ about them: the next batch finds those
    // that changed.
    ExitStatus merge(const std::vector<BatchTask>& tasks, BatchManifest& manifest,
                     const Context& context) {
        {
            Progress progress(context, "merging manifests");
            merge_shards(folder_, tasks, manifest, waits_, progress.call());
        }
        for (const BatchTask& task : tasks) {
            const BatchEntry* entry = manifest.find(task.key);
            ++done_;
            if (entry == nullptr || entry->command != task.command) {
                ++left_;
            } else if (entry->status != "ok") {
                count_failure(task, entry->status, entry->error);
            } else if (!has_outputs(task, *entry)) {
                ++left_;
            }
        }
        done_ -= left_;
        context.times.end("merging manifests");
        if (!page_.empty()) {
            OutputFile page(page_);
            write_page(tasks, manifest, page);
        }
        return print_result(context, tasks);
    }

    static void make_folder(const fs::path& folder) {
        std::error_code error;
        fs::create_directories(folder, error);
        if (!fs::is_directory(folder))
            throw Error(ErrorCode::io, folder.string() + ": cannot make this folder: " +
                                           (error ? error.message() : "a file has its name"));
    }

    // A name that a shell made of a pattern may be a model.
    void check_page() const {
        const std::string ending = fs::path(page_).extension().string();
        if (!page_.empty() && ending != ".html" && ending != ".htm")
            throw UsageError("--page: expected a name that ends in .html, not '" + page_ + "'");
    }

    std::vector<BatchTask> make_tasks(const Context& context) const {
        Progress progress(context, "finding models");
        const std::vector<std::string> words = batch_output_words(rest_);
        std::vector<BatchTask> tasks;
        std::map<std::string, const BatchInput*> of_output;
        const std::vector<BatchInput> inputs =
            find_batch_inputs(sources_, folder_, progress.call());
        if (inputs.empty()) throw Error(ErrorCode::bad_input, "no model among what was given");
        std::map<std::string, const BatchInput*> of_place;
        for (const BatchInput& input : inputs)
            of_place.emplace(place_of_model(input.model), &input);
        for (const BatchInput& input : inputs) {
            BatchTask task = make_batch_task(input, rest_, folder_);
            // Those of other shards too.
            for (std::size_t i = 0; i < task.outputs.size(); ++i) {
                const auto model = of_place.find(place_of_model(task.outputs[i]));
                if (model != of_place.end())
                    throw UsageError(task.outputs[i] + " is a model of this batch, which " +
                                     input.model + " would write: name another folder to write");
                const auto [other, is_first] = of_output.try_emplace(task.outputs[i], &input);
                if (is_first || other->second == &input) continue;
                throw UsageError(other->second->model + " and " + input.model +
                                 " would both write " + task.outputs[i] + ": " +
                                 advice_for_two(*other->second, input, words[i]));
            }
            if (shard_.contains(input)) tasks.push_back(std::move(task));
        }
        return tasks;
    }

    bool is_done(const BatchTask& task, const BatchManifest& manifest, const LongCall& call) const {
        const BatchEntry* entry = manifest.find(task.key);
        if (entry == nullptr || entry->command != task.command) return false;
        if (entry->status != "ok" && retries_) return false;
        try {
            if (entry->digest != digest_of(task.input.model, call)) return false;
        } catch (const Error& error) {
            if (error.code() == ErrorCode::cancelled) throw;
            return entry->digest.empty();
        }
        return has_outputs(task, *entry);
    }

    static bool has_outputs(const BatchTask& task, const BatchEntry& entry) {
        const std::vector<std::string> found = task.named_outputs();
        return std::ranges::all_of(entry.outputs, [&](const std::string& output) {
            return std::ranges::find(found, output) != found.end();
        });
    }

    struct Running {
        const BatchTask* task;
        std::string digest;
        std::unique_ptr<BatchProcess> process;
    };

    void run_all(const std::vector<const BatchTask*>& left, BatchManifest& manifest,
                 const Context& context) {
        Progress progress(context, "running " + rest_.front());
        const LongCall call = progress.call();
        std::size_t jobs = models_at_a_time();
        BatchLimits limits{.seconds = timeout_s_,
                           .memory_bytes = {},
                           .threads = std::max(1u, allowed_threads() / models_at_a_time())};
        if (memory_mb_) limits.memory_bytes = std::uint64_t(*memory_mb_ * 1e6);
        std::vector<Running> running;
        std::size_t next = 0, done = 0;
        while (next < left.size() || !running.empty()) {
            call.checkpoint(double(done) / double(std::max<std::size_t>(left.size(), 1)));
            while (running.size() < jobs && next < left.size()) {
                const BatchTask& task = *left[next];
                if (const std::string error = make_output_folders(task); !error.empty()) {
                    record(task, "", {.status = "failed", .error = error, .output = {}, .ms = 0.0},
                           manifest);
                    ++next;
                    ++done;
                    continue;
                }
                try {
                    start(task, limits, running, context);
                    ++next;
                } catch (const Error& error) {
                    if (error.code() != ErrorCode::io || running.empty()) throw;
                    jobs = running.size();  // The system allows no more at a time.
                }
            }
            bool has_ended = false;
            for (std::size_t i = 0; i < running.size();) {
                std::optional<BatchEnd> end = running[i].process->poll_end();
                if (!end) {
                    ++i;
                    continue;
                }
                record(*running[i].task, running[i].digest, *end, manifest);
                running.erase(running.begin() + std::ptrdiff_t(i));
                ++done;
                has_ended = true;
                check_usage(*end, done == left.size());
            }
            if (!has_ended) std::this_thread::sleep_for(k_poll);
        }
    }

    std::uint32_t models_at_a_time() const { return jobs_ > 0 ? jobs_ : allowed_threads(); }

    // A wrong option is wrong for all models: where all that were done first say the same of it, the rest need not be
    // tried.
    void check_usage(const BatchEnd& end, bool is_last) {
        usage_errors_.insert(end.error);
        const auto usage = kinds_.find("usage");
        const bool all_are = usage != kinds_.end() && usage->second == done_ && skipped_ == 0 &&
                             usage_errors_.size() == 1;
        if (all_are && (is_last || done_ >= k_tried))
            throw UsageError("of the subcommand: " + without_advice(words_of(end.error)),
                             rest_.front());
    }

    // Returns what is wrong with one; empty: nothing.
    static std::string make_output_folders(const BatchTask& task) {
        try {
            for (const std::string& output : task.outputs)
                make_folder(fs::absolute(output).parent_path());
        } catch (const Error& error) {
            return error.what();
        }
        return {};
    }

    void start(const BatchTask& task, const BatchLimits& limits, std::vector<Running>& running,
               const Context& context) const {
        std::string digest;
        try {
            digest = digest_of(task.input.model, {context.stop, {}});
        } catch (const Error& error) {
            if (error.code() == ErrorCode::cancelled) throw;
            // The subcommand says what is wrong with the file.
        }
        std::vector<std::string> arguments = task.arguments;
        arguments.emplace_back("--json");
        if (std::ranges::none_of(arguments, [](const std::string& word) {
                return word == "--threads" || word.starts_with("--threads=");
            }))
            arguments.insert(arguments.end(), {"--threads", std::to_string(limits.threads)});
        running.push_back({&task, digest, std::make_unique<BatchProcess>(arguments, limits)});
    }

    // Without "(see rimline draw --help)" at its end, which is added again.
    static std::string without_advice(std::string error) {
        const std::size_t advice = error.rfind(" (see rimline ");
        if (advice != std::string::npos) error.erase(advice);
        return error;
    }

    static std::string words_of(std::string error) {
        constexpr std::string_view k_prefix = "rimline: error: ";
        if (error.starts_with(k_prefix)) error.erase(0, k_prefix.size());
        return error;
    }

    void record(const BatchTask& task, const std::string& digest, const BatchEnd& end,
                BatchManifest& manifest) {
        const bool is_ok = end.status == "ok";
        nlohmann::ordered_json entry{
            {"input", task.key},
            {"digest", digest},
            {"command", task.command},
            {"status", end.status},
            {"ms", end.ms},
            {"outputs", is_ok ? task.named_outputs() : std::vector<std::string>()},
            {"error", nullptr},
            {"result", nullptr}};
        if (!is_ok) entry["error"] = words_of(end.error);
        auto result = nlohmann::ordered_json::parse(end.output, nullptr, false);
        if (!result.is_discarded()) entry["result"] = std::move(result);
        manifest.append(entry);
        ++done_;
        if (is_ok) return;
        count_failure(task, end.status, words_of(end.error));
    }

    void count_failure(const BatchTask& task, const std::string& kind, const std::string& error) {
        ++kinds_[kind];
        add_failure(first_failures_, task, error);
    }

    static void add_failure(std::vector<std::string>& failures, const BatchTask& task,
                            const std::string& error) {
        if (failures.size() < k_named_failures)
            failures.push_back(with_name(task.input.model, error));
    }

    // Most messages of subcommands begin with the name of the file, as print_error() writes it.
    static std::string with_name(const std::string& model, const std::string& error) {
        std::string line(model);
        std::ranges::replace(line, '\n', ' ');
        const bool has_name = error.starts_with(printable_text(line) + ":");
        return has_name ? error : model + ": " + error;
    }

    // Of all that the manifest has of these models.
    void write_page(const std::vector<BatchTask>& tasks, const BatchManifest& manifest,
                    OutputFile& file) const {
        std::vector<BatchPageItem> items;
        for (const BatchTask& task : tasks) {
            const BatchEntry* entry = manifest.find(task.key);
            if (entry == nullptr) continue;
            const bool is_ok = entry->status == "ok";
            items.push_back({task.input.model,
                             is_ok ? task.found_outputs() : std::vector<std::string>(),
                             is_ok ? "" : entry->status + ": " + entry->error});
        }
        file.write(batch_page(items, fs::absolute(page_).parent_path()));
        file.commit();
    }

    ExitStatus print_dry(const Context& context, const std::vector<BatchTask>& tasks,
                         const std::vector<const BatchTask*>& left, double mean_ms) const {
        const double rounds = std::ceil(double(left.size()) / models_at_a_time());
        const double estimate_s = 1e-3 * mean_ms * rounds;
        if (context.json) {
            nlohmann::ordered_json commands = nlohmann::ordered_json::array();
            for (const BatchTask* task : left) {
                std::vector<std::string> words{"rimline"};
                words.insert(words.end(), task->arguments.begin(), task->arguments.end());
                commands.push_back(std::move(words));
            }
            print_json(context, {{"models", tasks.size()},
                                 {"left", left.size()},
                                 {"estimate_s",
                                  mean_ms > 0.0 ? nlohmann::ordered_json(estimate_s) : nullptr},
                                 {"commands", std::move(commands)}});
            return ExitStatus::success;
        }
        for (const BatchTask* task : left) {
            std::string command = "rimline";
            for (const std::string& word : task->arguments) {
                command += ' ';
                command += quoted_for_shell(word);
            }
            std::printf("%s\n", command.c_str());
        }
        std::fprintf(stderr, "%zu of %zu models left to do", left.size(), tasks.size());
        if (mean_ms > 0.0)
            std::fprintf(stderr, ", about %.0f s by the times of those done", estimate_s);
        std::fputc('\n', stderr);
        return ExitStatus::success;
    }

    static void print_failures(const std::vector<std::string>& first, std::size_t count) {
        for (const std::string& failure : first)
            std::printf("    %s\n", printable_text(failure).c_str());
        if (count > first.size())
            std::printf("    and %zu more, in the manifest\n", count - first.size());
    }

    ExitStatus print_result(const Context& context, const std::vector<BatchTask>& tasks) const {
        std::size_t failed = 0;
        for (const auto& [kind, count] : kinds_) failed += count;
        if (context.json) {
            print_json(context, {{"models", tasks.size()},
                                 {"done", done_ - failed},
                                 {"skipped", skipped_},
                                 {"failed_before", failed_before_},
                                 {"failed", failed},
                                 {"kinds", kinds_},
                                 {"failures", first_failures_},
                                 {"failures_before", failures_before_},
                                 {"left", left_},
                                 {"manifest", manifest_path().string()}});
        } else {
            std::printf("%s\n", manifest_path().c_str());
            std::printf(
                "  models      %zu: %zu done, %zu done before, %zu failed, %zu failed before\n",
                tasks.size(), done_ - failed, skipped_, failed, failed_before_);
            for (const auto& [kind, count] : kinds_)
                std::printf("  %-11s %zu\n", kind.c_str(), count);
            print_failures(first_failures_, failed);
            if (failed_before_ > 0)
                std::printf("  before      %zu failed; --retry does them again\n", failed_before_);
            print_failures(failures_before_, failed_before_);
            if (left_ > 0) std::printf("  left        %zu\n", left_);
            std::printf("  time        %s\n", context.times.sentence().c_str());
        }
        if (failed + failed_before_ + left_ == 0) return ExitStatus::success;
        if (left_ > 0) {
            print_error(std::to_string(left_) + " of " + std::to_string(tasks.size()) +
                        " models are left to do: the same command without --merge does them");
            return ExitStatus::failed;
        }
        print_error(std::to_string(failed + failed_before_) + " of " +
                    std::to_string(tasks.size()) + " models failed: " + manifest_path().string() +
                    " says why" + (failed_before_ > 0 ? "; --retry does what failed again" : ""));
        return ExitStatus::failed;
    }

    static constexpr std::size_t k_named_failures = 5;
    static constexpr std::size_t k_tried = 3;

    std::vector<std::string> sources_, rest_;
    std::string folder_ = "batch", page_;
    Shard shard_;
    std::uint32_t jobs_ = 0;  // 0: one a processor.
    std::optional<double> timeout_s_, memory_mb_;
    bool is_dry_ = false, retries_ = false, merges_ = false, waits_ = false;
    std::size_t skipped_ = 0, failed_before_ = 0, done_ = 0, left_ = 0;
    std::map<std::string, std::size_t> kinds_;  // Of failures.
    std::set<std::string> usage_errors_;
    std::vector<std::string> first_failures_, failures_before_;
};

}  // namespace

std::unique_ptr<Command> make_batch_command() { return std::make_unique<BatchCommand>(); }

}  // namespace rimline::tools
