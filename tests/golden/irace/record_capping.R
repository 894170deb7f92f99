# Rscript record_capping.R > capping_traces.json: whole races with capping, as the irace package of
# Debian 12 (3.5) runs them. The target is a formula; everything that irace asks it for is noted.
suppressMessages(library(irace))

true_time <- function(x, y, id, instance, seed) {
  noise <- ((seed * 7919 + round(x * 1e4) * 104729 + round(y * 1e4) * 1299709) %% 10007) / 10007
  round(0.5 + 6 * abs(x - 0.3) + 4 * abs(y - 0.6) + 2 * noise + instance %% 3, 3)
}

number <- function(x) if (is.na(x)) "null" else format(x, digits = 15)
numbers <- function(x) paste0("[", paste(vapply(x, number, ""), collapse = ","), "]")

# One run of irace: its console, its log and the times without bounds of all calls, in order.
observe <- function(seed, options) {
  calls <- NULL
  target <- function(experiment, scenario) {
    value <- experiment$configuration
    full <- true_time(value[["x"]], value[["y"]], experiment$id.configuration,
                      experiment$id.instance, experiment$seed)
    calls <<- rbind(calls, data.frame(id = experiment$id.configuration, seed = experiment$seed,
                                      bound = experiment$bound, full = full))
    time <- min(full, experiment$bound)
    list(cost = time, time = time)
  }
  log_file <- tempfile(fileext = ".Rdata")
  scenario <- c(list(targetRunner = target, instances = 1:6, seed = seed, capping = 1,
                     digits = 4, logFile = log_file), options)
  parameters <- readParameters(text = 'x "" r (0,1)\ny "" r (0,1)\n')
  console <- capture.output(irace(scenario, parameters))
  load(log_file)
  list(console = console, calls = calls, log = iraceResults)
}

# The lines of each race: table rows, and the budget that was announced before them.
races_of <- function(console) {
  races <- list()
  budget <- NA
  open <- FALSE
  for (line in console) {
    if (grepl("^# currentBudget:", line)) budget <- as.numeric(sub(".*: *", "", line))
    if (grepl("^[|].[|] +[0-9]+[|]", line)) {
      if (!open) races[[length(races) + 1]] <- list(budget = budget, rows = character())
      races[[length(races)]]$rows <- c(races[[length(races)]]$rows, line)
      open <- TRUE
    } else if (open && !grepl("^[|]", line)) {
      open <- FALSE
    }
  }
  races
}

row_json <- function(line) {
  cells <- trimws(strsplit(sub("^[|](.)[|]", "", line), "[|]")[[1]])
  cells[cells == "NA"] <- "null"
  sprintf('{"symbol":"%s","pair":%s,"bound":%s,"alive":%s,"best":%s,"mean_best":%s,"experiments":%s}',
          substr(line, 2, 2), cells[1], cells[2], cells[3], cells[4], cells[5], cells[6])
}

race_json <- function(seed, options, seen, race, iteration) {
  all <- as.data.frame(seen$log$experimentLog)
  elites <- seen$log$allElites
  now <- all$iteration == iteration
  mine <- unique(all$configuration[now])
  before <- all[all$iteration < iteration, ]
  # With max_time the first race starts with those that the estimate was made from.
  first <- if (iteration == 1) unique(before$configuration) else elites[[iteration - 1]]
  ids <- c(first, sort(setdiff(mine, first)))
  past <- if (nrow(before)) max(before$instance) else 0
  # Times as the elites took them, costs as irace keeps them (with bound_par and time-outs).
  known <- function(values) {
    paste0("[", paste(vapply(first, function(id) {
      numbers(vapply(seq_len(past), function(pair) values(id, pair), 0))
    }, ""), collapse = ","), "]")
  }
  past_time <- function(id, pair) {
    hit <- which(before$configuration == id & before$instance == pair)
    if (length(hit)) before$time[hit[1]] else NA_real_
  }
  past_cost <- function(id, pair) {
    if (is.na(past_time(id, pair))) NA_real_ else seen$log$experiments[pair, as.character(id)]
  }
  entry <- function(name, value) sprintf('"%s":%s', name, value)
  calls <- mapply(function(id, pair, bound, full) sprintf("[%d,%d,%s,%s]", id, pair, number(bound),
                                                         number(full)),
                  all$configuration[now], all$instance[now], seen$calls$bound[now],
                  seen$calls$full[now])
  paste0("{", paste(c(
    entry("seed", seed), entry("iteration", iteration),
    entry("bound_type", sprintf('"%s"', options$boundType)),
    entry("capping_type", sprintf('"%s"', options$cappingType)),
    entry("test_type", sprintf('"%s"', options$testType)),
    entry("bound_max", number(options$boundMax)), entry("bound_digits", number(options$boundDigits)),
    entry("bound_par", number(options$boundPar)),
    entry("bound_as_timeout", if (options$boundAsTimeout == 1) "true" else "false"),
    entry("elitist_limit", number(options$elitistLimit)),
    entry("max_experiments", number(race$budget)), entry("past_pairs", past),
    entry("ids", numbers(ids)), entry("n_elites", length(first)),
    entry("past_times", known(past_time)), entry("past_costs", known(past_cost)),
    entry("calls", paste0("[", paste(calls, collapse = ","), "]")),
    entry("tasks", paste0("[", paste(vapply(race$rows, row_json, ""), collapse = ",\n"), "]"))),
    collapse = ",\n"), "}")
}

cases <- list(
  list(1, list(boundType = "candidate", cappingType = "median")),
  list(2, list(boundType = "instance", cappingType = "median")),
  list(3, list(boundType = "candidate", cappingType = "best", boundPar = 10)),
  list(4, list(boundType = "instance", cappingType = "worst", boundDigits = 2)),
  list(5, list(boundType = "instance", cappingType = "mean", boundDigits = 1, elitistLimit = 0)),
  list(6, list(boundType = "instance", cappingType = "best", boundAsTimeout = 0)),
  list(7, list(boundType = "instance", cappingType = "worst", testType = "F-test")),
  list(8, list(boundType = "instance", cappingType = "median", testType = "t-test-holm")),
  list(9, list(boundType = "instance", cappingType = "mean", boundPar = 10)))
defaults <- list(maxTime = 700, boundMax = 10, boundDigits = 0, boundPar = 1, boundAsTimeout = 1,
                 testType = "t-test", elitistLimit = 2)
found <- character()
for (case in cases) {
  options <- modifyList(defaults, case[[2]])
  seen <- observe(case[[1]], options)
  races <- races_of(seen$console)
  for (i in seq_along(races)) {
    found <- c(found, race_json(case[[1]], options, seen, races[[i]], i))
  }
}
cat("[", paste(found, collapse = ",\n"), "]\n", sep = "")
