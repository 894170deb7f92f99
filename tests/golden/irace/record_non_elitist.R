# Races without elitism, as the irace package of Debian 12 (3.5) runs them; all costs, and what the
# console says of each task.
#   Rscript record_non_elitist.R > non_elitist_traces.json
#   Rscript record_non_elitist.R f-race > f_race_traces.json    one race alone: our search f-race
suppressMessages(library(irace))

cost <- function(x, y, seed) {
  noise <- ((seed * 7919 + round(x * 1e4) * 104729 + round(y * 1e4) * 1299709) %% 10007) / 10007
  round(4 * abs(x - 0.3) + 2 * abs(y - 0.6) + 3 * noise, 3)
}

# One run of irace: races with their budgets and lines, and the experiments by iteration.
observe <- function(seed, options) {
  target <- function(experiment, scenario) {
    value <- experiment$configuration
    list(cost = cost(value[["x"]], value[["y"]], experiment$seed))
  }
  log_file <- tempfile(fileext = ".Rdata")
  scenario <- modifyList(list(targetRunner = target, instances = 1:6, seed = seed, elitist = 0,
                              digits = 4, maxExperiments = 400, logFile = log_file), options)
  parameters <- readParameters(text = 'x "" r (0,1)\ny "" r (0,1)\n')
  console <- capture.output(irace(scenario, parameters))
  load(log_file)
  list(console = console, log = iraceResults)
}

races_of <- function(console) {
  races <- list()
  budget <- NA
  for (line in console) {
    if (grepl("^# currentBudget:", line)) budget <- as.numeric(sub(".*: *", "", line))
    if (grepl("Instance[|] +Alive", line)) {
      races[[length(races) + 1]] <- list(budget = budget, rows = character())
    }
    if (grepl("^[|].[|] +[0-9]+[|]", line)) {
      races[[length(races)]]$rows <- c(races[[length(races)]]$rows, line)
    }
  }
  races
}

row_json <- function(line) {
  cells <- trimws(strsplit(sub("^[|](.)[|]", "", line), "[|]")[[1]])
  sprintf('{"symbol":"%s","pair":%s,"alive":%s,"best":%s,"mean_best":%s,"experiments":%s}',
          substr(line, 2, 2), cells[1], cells[2], cells[3], cells[4], cells[5])
}

race_json <- function(seed, options, seen, race, iteration) {
  all <- as.data.frame(seen$log$experimentLog)
  now <- all[all$iteration == iteration, ]
  first <- if (iteration == 1) integer() else seen$log$allElites[[iteration - 1]]
  ids <- c(first, sort(setdiff(unique(now$configuration), first)))
  costs <- mapply(function(id, pair) {
    sprintf("[%d,%d,%s]", id, pair,
            format(seen$log$experiments[pair, as.character(id)], digits = 15))
  }, now$configuration, now$instance)
  entry <- function(name, value) sprintf('"%s":%s', name, value)
  list_of <- function(texts) paste0("[", paste(texts, collapse = ","), "]")
  paste0("{", paste(c(
    entry("seed", seed), entry("iteration", iteration),
    entry("test_type", sprintf('"%s"', options$testType)),
    entry("first_test", options$firstTest), entry("each_test", options$eachTest),
    entry("confidence", options$confidence), entry("max_experiments", race$budget),
    entry("ids", list_of(ids)), entry("calls", list_of(costs)),
    entry("elites", list_of(seen$log$allElites[[iteration]])),
    entry("tasks", paste0("[", paste(vapply(race$rows, row_json, ""), collapse = ",\n"), "]"))),
    collapse = ",\n"), "}")
}

defaults <- list(testType = "F-test", firstTest = 5, eachTest = 1, confidence = 0.95)
cases <- list(list(), list(testType = "t-test"), list(testType = "t-test-holm"),
              list(testType = "t-test-bonferroni", eachTest = 2, firstTest = 4),
              list(firstTest = 6, eachTest = 3, confidence = 0.8))
if (identical(commandArgs(TRUE), "f-race")) {
  defaults <- c(defaults, list(nbIterations = 1, nbConfigurations = 200, elitistLimit = 0,
                               softRestart = 0, minNbSurvival = 1, maxExperiments = 4000))
  cases <- list(list(), list(), list(confidence = 0.999, maxExperiments = 1250),
                list(testType = "t-test"))
}
found <- character()
for (seed in seq_along(cases)) {
  options <- modifyList(defaults, cases[[seed]])
  seen <- observe(seed, options)
  races <- races_of(seen$console)
  for (i in seq_along(races)) found <- c(found, race_json(seed, options, seen, races[[i]], i))
}
cat("[", paste(found, collapse = ",\n"), "]\n", sep = "")
