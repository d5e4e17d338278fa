# A film in parts, each a job that draws some of its frames: see docs/batch.md.
#
#   snakemake -s batch/film.smk --configfile batch/film.yaml --workflow-profile batch/slurm

from pathlib import Path

SCENE, FILM, OPTIONS = config["scene"], config["film"], config["options"]
FRAMES, PER_JOB = int(config["frames"]), int(config["frames_per_job"])
FOLDER = Path(FILM).with_suffix("")
NAMES = f"{FOLDER}/frame_%06d.png"
FIRST = range(1, FRAMES + 1, PER_JOB)
PARTS = [f"{first:06d}..{min(first + PER_JOB - 1, FRAMES):06d}" for first in FIRST]
COMMAND = f"ugfilm -frames {FRAMES} {OPTIONS}"


wildcard_constraints:
    part=r"\d+\.\.\d+",


rule film:
    input:
        FILM,


# The frames themselves are no outputs: Snakemake would delete those that a failed job has finished.
rule part:
    input:
        SCENE,
    output:
        touch(f"{FOLDER}/parts/{{part}}"),
    threads: int(config["threads"])
    params:
        command=COMMAND,
        names=NAMES,
    shell:
        "{params.command} -nt {threads} -only {wildcards.part} -fo {params.names:q} {input:q}"


rule join:
    input:
        scene=SCENE,
        parts=expand(f"{FOLDER}/parts/{{part}}", part=PARTS),
    output:
        FILM,
    threads: int(config["threads"])
    params:
        command=COMMAND,
        names=NAMES,
    shell:
        "{params.command} -nt {threads} -keep {params.names:q} -fo {output:q} {input.scene:q}"
