# Pictures of programs and of the explorer.
use rule evidence as user_code_picture with:
    input:
        unpack(lambda wildcards: behind_engine(ancient(f"examples/figures/{wildcards.program}.py"))(wildcards)),
    output:
        "docs/user_code/{program}.png",
    log:
        "logs/validation/user_code_{program}.log",
    params:
        **evidence("user_code.picture"),


use rule evidence as explorer_picture with:
    input:
        unpack(behind_engine("results/explorer.html")),
    output:
        "docs/explorer.png",
    log:
        "logs/validation/explorer_picture.log",
    params:
        **evidence("explorer_picture.picture"),


# the worked example of docs/your_blade.md, as the page has it
use rule evidence as your_blade_pictures with:
    input:
        unpack(lambda wildcards: behind_engine(page=ancient("docs/your_blade.md"))(wildcards)),
    output:
        campbell="docs/your_blade_campbell.png",
        response="docs/your_blade_response.png",
        contact_force="docs/your_blade_contact_force.png",
    log:
        "logs/validation/your_blade_pictures.log",
    threads: workflow.cores
    params:
        **evidence("user_code.worked_example"),


# picture of a page -> the figure of a run that it is
PAGE_PICTURES = {
    "blades": "results/figures/blades.png",
    "interactions": "results/runs/interactions_quadratic/figures/interactions.png",
    "response_Ref": "results/figures/response_Ref.png",
    "casing_Ref": "results/runs/elastic_casing/figures/casing_Ref__elastic_abradable.png",
    "rotor": "results/runs/rotors/figures/rotor_Ref__rotor_abradable.png",
    "run_up_rates": "results/runs/run_ups/figures/run_up_rates_abradable.png",
    "search_slices": "results/runs/search_surrogate_2/figures/search_slices.png",
    "tolerances_Ref": "results/runs/members/figures/tolerances_Ref__material_abradable.png",
}


rule picture_of_a_run:
    input:
        unpack(lambda wildcards: behind_engine(PAGE_PICTURES[wildcards.picture])(wildcards)),
    output:
        "docs/{picture}.png",
    log:
        "logs/validation/{picture}.log",
    wildcard_constraints:
        picture="|".join(PAGE_PICTURES),
    conda:
        ROOT / "envs/r37.yaml"
    shell:
        "cp {input:q} {output:q}"
